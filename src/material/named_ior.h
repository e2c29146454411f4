// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/rgb.h"

namespace brume {

/// Complex index of refraction eta + i k.
struct ConductorIor {
  Rgb eta, k;
};

/// Index of refraction of a dielectric by Mitsuba's name, upper and lower case alike; nothing for
/// an unknown name.
std::optional<float> dielectric_ior(std::string_view name);
std::vector<std::string_view> dielectric_names();

/// Of a conductor by Mitsuba's name: the chemical symbol, or "none" for a perfect mirror; nothing
/// for an unknown name.
std::optional<ConductorIor> conductor_ior(std::string_view name);
std::vector<std::string_view> conductor_names();

}  // namespace brume
