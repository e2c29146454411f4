// SPDX-License-Identifier: Apache-2.0
#include "material/checkerboard_texture.h"

#include <utility>

namespace brume {

CheckerboardTexture::CheckerboardTexture(std::shared_ptr<const Texture> color0,
                                         std::shared_ptr<const Texture> color1,
                                         const glm::mat3& to_uv)
    : color0_(std::move(color0)), color1_(std::move(color1)), to_uv_(to_uv) {}

Rgb CheckerboardTexture::value(const Vec2& uv) const {
  const Vec2 p(to_uv_ * Vec3(uv, 1.0f));
  const Vec2 f = p - glm::floor(p);
  const bool same_half = (f.x > 0.5f) == (f.y > 0.5f);
  return (same_half ? color0_ : color1_)->value(uv);
}

}  // namespace brume
