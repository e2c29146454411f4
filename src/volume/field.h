// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "core/rgb.h"

namespace brume {

template <class Value>
class Grid;

/// A colour over world space, such as an albedo.
class ColorField {
 public:
  virtual ~ColorField() = default;
  virtual Rgb value(const Vec3& p) const = 0;
  /// The colour, if it is known to be the same everywhere.
  virtual std::optional<Rgb> constant() const { return std::nullopt; }
};

class ConstantField final : public ColorField {
 public:
  explicit ConstantField(const Rgb& value) : value_(value) {}
  Rgb value(const Vec3& /*p*/) const override { return value_; }
  std::optional<Rgb> constant() const override { return value_; }

 private:
  Rgb value_;
};

/// A grid looked up at world points; a scalar grid is grey.
std::shared_ptr<const ColorField> make_grid_field(std::shared_ptr<const Grid<float>> grid);
std::shared_ptr<const ColorField> make_grid_field(std::shared_ptr<const Grid<Rgb>> grid);

}  // namespace brume
