// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/rgb.h"
#include "core/vec.h"

namespace brume {

/// A colour over the surface parameters.
class Texture {
 public:
  virtual ~Texture() = default;
  virtual Rgb value(const Vec2& uv) const = 0;
};

class ConstantTexture final : public Texture {
 public:
  explicit ConstantTexture(const Rgb& value) : value_(value) {}
  Rgb value(const Vec2& /*uv*/) const override { return value_; }

 private:
  Rgb value_;
};

}  // namespace brume
