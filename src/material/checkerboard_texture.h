// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/texture.h"

namespace brume {

/// Two squares by two over each unit of uv: `color0` where both coordinates lie in the same half.
class CheckerboardTexture final : public Texture {
 public:
  /// `to_uv` is applied to (u, v, 1).
  CheckerboardTexture(std::shared_ptr<const Texture> color0, std::shared_ptr<const Texture> color1,
                      const glm::mat3& to_uv);

  Rgb value(const Vec2& uv) const override;

 private:
  std::shared_ptr<const Texture> color0_, color1_;
  glm::mat3 to_uv_;
};

}  // namespace brume
