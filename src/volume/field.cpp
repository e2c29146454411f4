// SPDX-License-Identifier: Apache-2.0
#include "volume/field.h"

#include <glm/vec4.hpp>

#include "volume/grid.h"

namespace brume {
namespace {

template <class Value>
class GridField final : public ColorField {
 public:
  explicit GridField(std::shared_ptr<const Grid<Value>> grid) : grid_(std::move(grid)) {}

  Rgb value(const Vec3& p) const override {
    const Vec3 index = grid_->wrapped(Vec3(grid_->index_from_world() * glm::dvec4(p, 1.0)));
    GridLookup<Value> lookup(*grid_);
    return Rgb(grid_->interpolation() == Interpolation::kNearest ? lookup.nearest(index)
                                                                 : lookup.trilinear(index));
  }

 private:
  std::shared_ptr<const Grid<Value>> grid_;
};

}  // namespace

std::shared_ptr<const ColorField> make_grid_field(std::shared_ptr<const Grid<float>> grid) {
  return std::make_shared<GridField<float>>(std::move(grid));
}

std::shared_ptr<const ColorField> make_grid_field(std::shared_ptr<const Grid<Rgb>> grid) {
  return std::make_shared<GridField<Rgb>>(std::move(grid));
}

}  // namespace brume
