// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>

#include "study/colour_scale.h"
#include "study/heat_map.h"

namespace brume {
namespace {

constexpr int kGlyphWidth = 3, kGlyphHeight = 5, kGlyphScale = 2;  // [dot], [dot], [pixel/dot]
constexpr int kAdvance = (kGlyphWidth + 1) * kGlyphScale;          // [pixel]
constexpr int kMargin = 6, kBarHeight = 12, kTick = 4;             // [pixel]
constexpr int kLegendHeight =
    kMargin + kBarHeight + kTick + 2 + kGlyphHeight * kGlyphScale + kMargin;
constexpr int kMinWidth = 240;  // [pixel] that the labels need

/// Rows from the top, the leftmost dot in the highest bit.
std::array<unsigned char, kGlyphHeight> glyph(char c) {
  switch (c) {
    case '0':
      return {0b111, 0b101, 0b101, 0b101, 0b111};
    case '1':
      return {0b010, 0b110, 0b010, 0b010, 0b111};
    case '.':
      return {0b000, 0b000, 0b000, 0b000, 0b010};
    case '%':
      return {0b101, 0b001, 0b010, 0b100, 0b101};
    default:
      assert(false && "not a character of any label");
      return {};
  }
}

void set(Image& image, int x, int y, const Rgb& colour) {
  for (int c = 0; c < 3; ++c) image.at(x, y, std::size_t(c)) = colour[c];
}

void draw_text(Image& image, int left, int top, std::string_view text) {
  for (const char c : text) {
    const auto rows = glyph(c);
    for (int y = 0; y < kGlyphHeight * kGlyphScale; ++y)
      for (int x = 0; x < kGlyphWidth * kGlyphScale; ++x)
        if (rows[std::size_t(y / kGlyphScale)] >> (kGlyphWidth - 1 - x / kGlyphScale) & 1)
          set(image, left + x, top + y, Rgb{0.0f});
    left += kAdvance;
  }
}

}  // namespace

Image with_legend(const Image& map) {
  const int zoom = std::max((kMinWidth + map.width - 1) / map.width, 1);
  Image result{.width = map.width * zoom,
               .height = map.height * zoom + kLegendHeight,
               .channels = {"R", "G", "B"}};
  result.pixels.assign(std::size_t(result.width) * std::size_t(result.height) * 3, 1.0f);
  for (int y = 0; y < map.height * zoom; ++y)
    for (int x = 0; x < result.width; ++x)
      set(result, x, y,
          {map.at(x / zoom, y / zoom, 0), map.at(x / zoom, y / zoom, 1),
           map.at(x / zoom, y / zoom, 2)});

  const int bar_top = map.height * zoom + kMargin;
  const int bar_width = result.width - 2 * kMargin;
  for (int x = 0; x < bar_width; ++x)
    for (int y = 0; y < kBarHeight; ++y)
      set(result, kMargin + x, bar_top + y, scale_colour(double(x) / (bar_width - 1)));
  for (const HeatMark& mark : heat_marks()) {
    const int x = kMargin + int(mark.position * (bar_width - 1));
    for (int y = 0; y < kTick; ++y) set(result, x, bar_top + kBarHeight + y, Rgb{0.0f});
    const int text_width = int(mark.label.size()) * kAdvance - kGlyphScale;
    const int left = std::clamp(x - text_width / 2, kMargin, result.width - kMargin - text_width);
    draw_text(result, left, bar_top + kBarHeight + kTick + 2, mark.label);
  }
  return result;
}

}  // namespace brume
