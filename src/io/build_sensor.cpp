// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <numbers>

#include "camera/field_of_view.h"
#include "camera/orthographic_camera.h"
#include "camera/perspective_camera.h"
#include "geometry/similarity.h"
#include "io/number_text.h"
#include "io/scene_builder.h"

namespace brume {
namespace {

using FilterPtr = std::shared_ptr<const Filter>;

FilterPtr build_box(const SceneNode& node) {
  return std::make_shared<BoxFilter>(float(node.number("radius", 0.5, kPositive)));
}
FilterPtr build_tent(const SceneNode& node) {
  return std::make_shared<TentFilter>(float(node.number("radius", 1.0, kPositive)));
}
FilterPtr build_gaussian(const SceneNode& node) {
  return std::make_shared<GaussianFilter>(float(node.number("stddev", 0.5, kPositive)));
}

constexpr Plugin<FilterPtr (*)(const SceneNode&)> kFilters[] = {
    {"box", build_box}, {"tent", build_tent}, {"gaussian", build_gaussian}};

FilterPtr filter_of(const SceneNode* film) {
  const SceneNode* node = film != nullptr ? film->only_child("rfilter") : nullptr;
  if (node == nullptr) return std::make_shared<GaussianFilter>();
  FilterPtr filter = find_plugin(*node, kFilters)(*node);
  node->finish();
  return filter;
}

constexpr int kMaxSize = 1 << 16;  // [pixel] along one side

FilmSettings hdr_film(const SceneNode& node, BuildContext& context,
                      const std::optional<glm::ivec2>& size) {
  FilmSettings film;
  film.size = {int(node.integer("width", 768, 1, kMaxSize)),
               int(node.integer("height", 576, 1, kMaxSize))};
  film.crop_offset = {int(node.integer("crop_offset_x", 0, 0, film.size.x - 1)),
                      int(node.integer("crop_offset_y", 0, 0, film.size.y - 1))};
  const glm::ivec2 rest = film.size - film.crop_offset;
  film.crop_size = {int(node.integer("crop_width", rest.x, 1, rest.x)),
                    int(node.integer("crop_height", rest.y, 1, rest.y))};
  if (size) {
    if (film.crop_size != film.size) {
      context.notices.note("another picture size was asked for: the film's crop is left out");
    }
    film.size = film.crop_size = *size;
    film.crop_offset = {0, 0};
  }
  const std::string pixel_format =
      node.choice("pixel_format", {"rgb", "rgba", "luminance", "luminance_alpha", "xyz", "xyza"});
  if (!pixel_format.starts_with("rgb")) {
    context.notices.warn(
        fmt::format("pixel_format \"{}\": pictures are RGB with alpha all the same", pixel_format));
  }
  // The output file decides these.
  node.choice("file_format", {"openexr", "exr", "rgbe", "pfm"});
  node.choice("component_format", {"float16", "float32", "uint32"});
  context.accept(node, {"sample_border", "compensate"});
  if (node.old_dialect) context.accept(node, {"banner", "attach_log", "high_quality_edges"});
  return film;
}

constexpr Plugin<FilmSettings (*)(const SceneNode&, BuildContext&,
                                  const std::optional<glm::ivec2>&)>
    kFilms[] = {{"hdrfilm", hdr_film}};

FilmSettings film_of(const SceneNode& sensor, BuildContext& context,
                     const std::optional<glm::ivec2>& size) {
  const SceneNode* node = sensor.only_child("film");
  FilmSettings film;
  if (node != nullptr) {
    film = find_plugin(*node, kFilms)(*node, context, size);
  } else if (size) {
    film.size = film.crop_size = *size;
  }
  film.filter = filter_of(node);
  if (node != nullptr) node->finish();
  return film;
}

// Every sampler of Mitsuba is replaced by brume's own.
int sample_count(const SceneNode& node, BuildContext& context) {
  context.accept(node, {"seed", "jitter", "dimension", "strength"});
  return int(node.integer("sample_count", 16, 1, 1 << 30));
}

constexpr Plugin<int (*)(const SceneNode&, BuildContext&)> kSamplers[] = {
    {"independent", sample_count},
    {"stratified", sample_count},
    {"multijitter", sample_count},
    {"orthogonal", sample_count},
    {"ldsampler", sample_count}};

int sample_count_of(const SceneNode& sensor, BuildContext& context) {
  const SceneNode* node = sensor.only_child("sampler");
  if (node == nullptr) return SensorSettings{}.sample_count;
  const int count = find_plugin(*node, kSamplers)(*node, context);
  node->finish();
  return count;
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

// Full horizontal angle [rad].
double x_fov(const SceneNode& node, double aspect) {
  const std::string axis_name =
      node.choice("fov_axis", {"x", "y", "diagonal", "smaller", "larger"});
  if (node.has("fov")) {
    if (node.has("focal_length")) {
      fail_at(node.position("focal_length"),
              fmt::format("{} has both fov and focal_length; give one of them", node.label()));
    }
    const double fov_deg = node.number("fov", 0.0, {.min = 1e-4, .max = 179.999});
    const FovAxis axis = axis_name == "x"          ? FovAxis::kX
                         : axis_name == "y"        ? FovAxis::kY
                         : axis_name == "diagonal" ? FovAxis::kDiagonal
                         : axis_name == "smaller"  ? FovAxis::kSmaller
                                                   : FovAxis::kLarger;
    return horizontal_fov(radians(fov_deg), axis, aspect);
  }
  const std::string text = node.text("focal_length", "50mm");
  const auto focal_length_mm =
      parse_number(text.ends_with("mm") ? text.substr(0, text.size() - 2) : text);
  if (!focal_length_mm || *focal_length_mm <= 0.0) {
    fail_at(node.position("focal_length"),
            fmt::format("\"{}\" is not a focal length, such as \"50mm\"", text));
  }
  return horizontal_fov(diagonal_fov_of_focal_length(*focal_length_mm), FovAxis::kDiagonal, aspect);
}

ClipRange clip_range(const SceneNode& node) {
  const ClipRange defaults;
  const double near = node.number("near_clip", defaults.near, kPositive);
  const double far = node.number("far_clip", std::max(defaults.far, 2.0 * near), kPositive);
  if (far <= near) {
    node.fail(fmt::format("far_clip {} of {} is not beyond near_clip {}", far, node.label(), near));
  }
  return {.near = near, .far = far};
}

// Cameras with a field of view are moved, turned and mirrored, but not scaled.
glm::dmat4 rigid_transform(const SceneNode& node, const BuildContext& context) {
  const auto s = as_similarity(context.to_world(node));
  constexpr double kTolerance = 1e-3;
  if (!s || std::abs(s->scale - 1.0) > kTolerance) {
    fail_at(node.position("to_world"),
            fmt::format("to_world of {} scales or shears, which a camera cannot", node.label()));
  }
  glm::dmat4 m(s->rotation);
  m[3] = glm::dvec4(s->offset, 1.0);
  return m;
}

PerspectiveView view(const SceneNode& node, double aspect, const BuildContext& context) {
  return {.to_world = rigid_transform(node, context),
          .x_fov = x_fov(node, aspect),
          .aspect = aspect,
          .clip = clip_range(node),
          .principal_point_offset = {node.number("principal_point_offset_x", 0.0),
                                     node.number("principal_point_offset_y", 0.0)}};
}

using CameraPtr = std::shared_ptr<const Camera>;

CameraPtr build_perspective(const SceneNode& node, double aspect, BuildContext& context) {
  context.accept(node, {"focus_distance"});
  return std::make_shared<PerspectiveCamera>(view(node, aspect, context));
}

CameraPtr build_thin_lens(const SceneNode& node, double aspect, BuildContext& context) {
  node.require("aperture_radius", "radius of the lens in scene units");
  const PerspectiveView v = view(node, aspect, context);
  return std::make_shared<ThinLensCamera>(v, node.number("aperture_radius", 0.0, kNonNegative),
                                          node.number("focus_distance", v.clip.far, kPositive));
}

CameraPtr build_orthographic(const SceneNode& node, double aspect, BuildContext& context) {
  context.accept(node, {"focus_distance"});
  return std::make_shared<OrthographicCamera>(context.to_world(node), aspect, clip_range(node));
}

constexpr Plugin<CameraPtr (*)(const SceneNode&, double, BuildContext&)> kSensors[] = {
    {"perspective", build_perspective},
    {"thinlens", build_thin_lens},
    {"orthographic", build_orthographic}};

}  // namespace

SensorSettings build_sensor(const SceneNode& node, BuildContext& context,
                            const std::optional<glm::ivec2>& size) {
  const auto build_camera = find_plugin(node, kSensors);
  SensorSettings sensor;
  sensor.film = film_of(node, context, size);
  sensor.sample_count = sample_count_of(node, context);
  const double aspect = double(sensor.film.size.x) / double(sensor.film.size.y);
  sensor.camera = build_camera(node, aspect, context);
  context.accept(node, {"shutter_open", "shutter_close"});
  sensor.medium = node.only_child("medium");
  for (const SceneNode::Child& child : node.children_of("medium")) sensor.medium_at = child.at;
  node.finish();
  return sensor;
}

}  // namespace brume
