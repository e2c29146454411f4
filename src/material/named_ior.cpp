// SPDX-License-Identifier: Apache-2.0
#include "material/named_ior.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace brume {

namespace {

struct NamedDielectric {
  std::string_view name;
  float ior;
};

/// At 589 nm and 0 to 20 degrees Celsius, mostly from Hecht 2001, table 4.1; the names and values
/// are those that Mitsuba 3 documents.
constexpr std::array kDielectrics{
    NamedDielectric{"vacuum", 1.0f},
    NamedDielectric{"helium", 1.000036f},
    NamedDielectric{"hydrogen", 1.000132f},
    NamedDielectric{"air", 1.000277f},
    NamedDielectric{"carbon dioxide", 1.00045f},
    NamedDielectric{"water", 1.3330f},
    NamedDielectric{"acetone", 1.36f},
    NamedDielectric{"ethanol", 1.361f},
    NamedDielectric{"carbon tetrachloride", 1.461f},
    NamedDielectric{"glycerol", 1.4729f},
    NamedDielectric{"benzene", 1.501f},
    NamedDielectric{"silicone oil", 1.52045f},
    NamedDielectric{"bromine", 1.661f},
    NamedDielectric{"water ice", 1.31f},
    NamedDielectric{"fused quartz", 1.458f},
    NamedDielectric{"pyrex", 1.470f},
    NamedDielectric{"acrylic glass", 1.49f},
    NamedDielectric{"polypropylene", 1.49f},
    NamedDielectric{"bk7", 1.5046f},
    NamedDielectric{"sodium chloride", 1.544f},
    NamedDielectric{"amber", 1.55f},
    NamedDielectric{"pet", 1.5750f},
    NamedDielectric{"diamond", 2.419f},
};

struct NamedConductor {
  std::string_view name;
  ConductorIor ior;
};

/// Spectra of the Luxpop database (Palik 1998), weighted with the CIE 1931 curves under light of
/// equal energy and turned into linear Rec. 709. Such light is reddish in Rec. 709, so that the
/// numbers are too; they are kept because Mitsuba's RGB mode has them.
const std::array kConductors{
    NamedConductor{"none", {Rgb(0.0f), Rgb(1.0f)}},
    NamedConductor{"a-C",
                   {Rgb(2.944100f, 2.227150f, 1.968167f), Rgb(0.887433f, 0.799322f, 0.815286f)}},
    NamedConductor{"Ag",
                   {Rgb(0.155265f, 0.116723f, 0.138381f), Rgb(4.828343f, 3.122246f, 2.146950f)}},
    NamedConductor{"Al",
                   {Rgb(1.657460f, 0.880369f, 0.521229f), Rgb(9.223869f, 6.269523f, 4.837001f)}},
    NamedConductor{"Au",
                   {Rgb(0.143119f, 0.374957f, 1.442479f), Rgb(3.983160f, 2.385721f, 1.603215f)}},
    NamedConductor{"Be",
                   {Rgb(4.185059f, 3.185060f, 2.784091f), Rgb(3.835440f, 3.010126f, 2.869009f)}},
    NamedConductor{"Cr",
                   {Rgb(4.369683f, 2.916702f, 1.654701f), Rgb(5.206434f, 4.231365f, 3.754947f)}},
    NamedConductor{"Cu",
                   {Rgb(0.200438f, 0.924033f, 1.102212f), Rgb(3.912949f, 2.452848f, 2.142188f)}},
    NamedConductor{"Cu_palik",
                   {Rgb(0.212684f, 0.919988f, 1.102408f), Rgb(3.921563f, 2.457149f, 2.136653f)}},
    NamedConductor{"Hg",
                   {Rgb(2.398931f, 1.440025f, 0.909551f), Rgb(6.327627f, 4.371941f, 3.421790f)}},
    NamedConductor{"Ir",
                   {Rgb(3.086410f, 2.082194f, 1.617887f), Rgb(5.592151f, 4.067176f, 3.267261f)}},
    NamedConductor{"K",
                   {Rgb(0.064049f, 0.046410f, 0.038184f), Rgb(2.104216f, 1.348936f, 0.913211f)}},
    NamedConductor{"Li",
                   {Rgb(0.265787f, 0.195610f, 0.220920f), Rgb(3.540174f, 2.311131f, 1.668593f)}},
    NamedConductor{"Mo",
                   {Rgb(4.483701f, 3.525458f, 2.776077f), Rgb(4.111131f, 3.420872f, 3.150603f)}},
    NamedConductor{"Na_palik",
                   {Rgb(0.060267f, 0.056141f, 0.061991f), Rgb(3.179291f, 2.112480f, 1.579094f)}},
    NamedConductor{"Nb",
                   {Rgb(3.420135f, 2.790192f, 2.395586f), Rgb(3.441382f, 2.737644f, 2.579913f)}},
    NamedConductor{"Ni_palik",
                   {Rgb(2.367275f, 1.663358f, 1.467055f), Rgb(4.498833f, 3.050164f, 2.345427f)}},
    NamedConductor{"Rh",
                   {Rgb(2.585795f, 1.860187f, 1.554428f), Rgb(6.782293f, 4.702950f, 3.976089f)}},
    NamedConductor{"Ta",
                   {Rgb(2.062585f, 2.393092f, 2.628068f), Rgb(2.408047f, 1.741371f, 1.947038f)}},
    NamedConductor{"TiN",
                   {Rgb(1.648469f, 1.150448f, 1.379780f), Rgb(3.368460f, 1.943489f, 1.102012f)}},
    NamedConductor{"V_palik",
                   {Rgb(4.277513f, 3.513154f, 2.761126f), Rgb(3.491184f, 2.889358f, 3.111697f)}},
    NamedConductor{"W",
                   {Rgb(4.370703f, 3.300297f, 2.998267f), Rgb(3.500678f, 2.604865f, 2.273193f)}},
};

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

}  // namespace

std::optional<float> dielectric_ior(std::string_view name) {
  for (const NamedDielectric& entry : kDielectrics) {
    if (equal_ignoring_case(entry.name, name)) return entry.ior;
  }
  return std::nullopt;
}

std::vector<std::string_view> dielectric_names() {
  std::vector<std::string_view> names;
  for (const NamedDielectric& entry : kDielectrics) names.push_back(entry.name);
  return names;
}

std::optional<ConductorIor> conductor_ior(std::string_view name) {
  for (const NamedConductor& entry : kConductors) {
    if (entry.name == name) return entry.ior;
  }
  return std::nullopt;
}

std::vector<std::string_view> conductor_names() {
  std::vector<std::string_view> names;
  for (const NamedConductor& entry : kConductors) names.push_back(entry.name);
  return names;
}

}  // namespace brume
