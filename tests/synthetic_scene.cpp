#include "synthetic_scene.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sundial::test {
namespace {

struct Vector {
  double x, y, z;
};
constexpr Vector kEye{9, 6, 10};
constexpr double kExtent = 20;               // metres to each side of the origin
constexpr double kSunX = -0.5, kSunZ = 0.3;  // metres that the light moves while it falls one metre

Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(double s, Vector v) { return {s * v.x, s * v.y, s * v.z}; }
Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector unit(Vector v) { return 1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z) * v; }

// Is the point of the plane in the shadow of one of the discs? They stand on a jittered lattice.
bool shadowed(double x, double z) {
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j) {
      const double height = 1 + 0.37 * ((i * 7 + j * 13) & 3), radius = 0.45 + 0.12 * ((i * 3 + j * 5) & 3);
      const double dx = x - (2.1 * i + height * kSunX), dz = z - (2.1 * j + height * kSunZ);
      if (dx * dx + dz * dz < radius * radius) return true;
    }
  return false;
}

bool isTraced(const v1::MethodChoice& method) { return method.name() == "ray-traced"; }

double texelsOf(const v1::MethodChoice& method) {
  const auto found = method.parameters().find("texels");
  return found == method.parameters().end() ? 2048 : std::stod(found->second);
}

// A desired view spends the map on half of the extent.
double texelSize(const v1::MethodChoice& method) {
  return (method.name() == "dv" ? 1 : 2) * kExtent / texelsOf(method);
}

template <class T>
void append(std::string& bytes, std::initializer_list<T> values) {
  for (const T value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void set(v1::Vec3& vector, Vector v) {
  vector.set_x(v.x);
  vector.set_y(v.y);
  vector.set_z(v.z);
}

}  // namespace

v1::Accepted acceptedOf(const v1::RenderRequest& request) {
  v1::Accepted accepted;
  accepted.set_request_id("r1");
  accepted.set_device("fake device");
  accepted.set_driver("fake driver 1.0");
  for (const int aov : request.images()) {
    const std::uint64_t pixel = aov == v1::ID ? 8 : aov == v1::POSITION || aov == v1::NORMAL ? 12 : 4;
    accepted.set_bytes_expected(accepted.bytes_expected() +
                                pixel * request.width() * request.height() *
                                    static_cast<std::uint64_t>(request.methods_size()));
  }
  *accepted.mutable_view() = request.view();
  if (!request.has_view()) {
    set(*accepted.mutable_view()->mutable_eye(), kEye);
    set(*accepted.mutable_view()->mutable_target(), {0, 0, 0});
    set(*accepted.mutable_view()->mutable_up(), {0, 1, 0});
    accepted.mutable_view()->set_vertical_fov_degrees(50);
  }
  *accepted.mutable_light() = request.light();
  if (!request.has_light())
    set(*accepted.mutable_light()->mutable_sun()->mutable_direction(), {kSunX, -1, kSunZ});
  return accepted;
}

SyntheticScene::SyntheticScene(const v1::RenderRequest& request) : request_(request) {
  const Vector forward = unit(Vector{0, 0, 0} - kEye), right = unit(cross(forward, {0, 1, 0})),
               up = cross(right, forward);
  const double tangent = std::tan(25 * M_PI / 180);
  for (unsigned row = 0; row < request.height(); ++row)
    for (unsigned column = 0; column < request.width(); ++column) {
      const double u = (2 * (column + 0.5) - request.width()) / request.height() * tangent;
      const double v = (1 - 2 * (row + 0.5) / request.height()) * tangent;
      const Vector ray = forward + u * right + v * up;
      Sample sample;
      if (ray.y < 0) {
        const Vector point = kEye + (-kEye.y / ray.y) * ray;
        sample = {point.x, point.z, std::abs(point.x) < kExtent && std::abs(point.z) < kExtent, false};
        sample.lit = sample.hit && !shadowed(point.x, point.z);
      }
      samples_.push_back(sample);
    }
}

// What a map of texels of that size would answer: the truth at the centre of the texel.
bool SyntheticScene::visible(const v1::MethodChoice& method, const Sample& sample) const {
  if (!sample.hit || isTraced(method)) return sample.lit;
  const double texel = texelSize(method);
  const auto centre = [&](double value) { return (std::floor(value / texel) + 0.5) * texel; };
  return !shadowed(centre(sample.x), centre(sample.z));
}

std::string SyntheticScene::image(const v1::MethodChoice& method, v1::Aov aov) const {
  std::string bytes;
  constexpr std::uint32_t kNone = 0xffffffff;
  for (const Sample& s : samples_) {
    const auto x = static_cast<float>(s.x), z = static_cast<float>(s.z);
    switch (aov) {
      case v1::COLOUR: {
        const bool light = (static_cast<int>(std::floor(s.x)) + static_cast<int>(std::floor(s.z))) & 1;
        const int shade = (light ? 210 : 170) * (visible(method, s) ? 100 : 35) / 100;
        const auto level = static_cast<std::uint8_t>(shade), warm = static_cast<std::uint8_t>(shade * 9 / 10);
        if (s.hit) append<std::uint8_t>(bytes, {level, level, warm, 255});
        if (!s.hit) append<std::uint8_t>(bytes, {120, 150, 190, 0});
        break;
      }
      case v1::VISIBILITY:
        append(bytes, {visible(method, s) ? 1.0f : 0.0f});
        break;
      case v1::REFERENCE:
        append(bytes, {s.lit ? 1.0f : 0.0f});
        break;
      case v1::POSITION:
        append(bytes, {s.hit ? x : 0, 0.0f, s.hit ? z : 0});
        break;
      case v1::NORMAL:
        append(bytes, {0.0f, s.hit ? 1.0f : 0.0f, 0.0f});
        break;
      case v1::ID:
        append<std::uint32_t>(bytes, {s.hit ? 3 : kNone, s.hit ? 16777217u : kNone});
        break;
      case v1::VIEW:
        append<std::uint32_t>(bytes, {s.hit && !isTraced(method) ? viewOf(method, s) : kNone});
        break;
      case v1::CLASS:
        append<std::uint32_t>(bytes, {kNone});
        break;
      default:
        break;
    }
  }
  return bytes;
}

std::uint32_t SyntheticScene::viewOf(const v1::MethodChoice& method, const Sample& sample) const {
  return method.name() == "csm" && sample.z < 0 ? 1 : 0;
}

v1::Plan SyntheticScene::plan(const v1::MethodChoice& method) const {
  v1::Plan plan;
  if (isTraced(method)) return plan;
  const double half = texelSize(method) * texelsOf(method) / 2;
  const auto texels = static_cast<std::uint32_t>(texelsOf(method));
  for (std::uint32_t v = 0; v < (method.name() == "csm" ? 2u : 1u); ++v) {
    v1::PlanView& view = *plan.add_views();
    // Seen along the sun: x' = x + y kSunX, z' = z + y kSunZ are constant along a ray of light.
    for (const double value : {1 / half, kSunX / half, 0.0, 0.0, 0.0, kSunZ / half, 1 / half, 0.0, 0.0, 0.05,
                               0.0, 0.5, 0.0, 0.0, 0.0, 1.0})
      view.add_shadow_from_world(value);
    for (const std::uint32_t value : {v * texels, 0u, texels, texels}) view.add_rect(value);
    view.set_near(-10);
    view.set_far(10);
    view.set_texel_size(texelSize(method));
    if (method.name() == "csm") {
      view.set_depth_begin(10 * v);
      view.set_depth_end(10 * (v + 1));
    }
  }
  return plan;
}

v1::Result SyntheticScene::result(const v1::MethodChoice& method) const {
  v1::Result result;
  result.set_method(method.name());
  *result.mutable_parameters() = method.parameters();
  double lit = 0, dark = 0, all = 0;
  for (const Sample& s : samples_) {
    if (!s.hit) continue;
    const bool answer = visible(method, s);
    ++all;
    lit += answer && !s.lit;
    dark += !answer && s.lit;
  }
  v1::Measures& measures = *result.mutable_measures();
  measures.set_pixel_match(1 - (lit + dark) / all);
  measures.set_false_lit(lit / all);
  measures.set_false_shadow(dark / all);
  measures.set_mean_abs_error((lit + dark) / all);
  measures.mutable_edge_error_px()->set_p50(0.7);
  measures.mutable_edge_error_px()->set_p95(isTraced(method) ? 0 : 2000 / texelsOf(method));
  measures.set_store_bytes(isTraced(method) ? 0 : 4 * texelsOf(method) * texelsOf(method));
  measures.set_total_bytes(measures.store_bytes() + 1e6);
  measures.set_allocated_bytes(measures.total_bytes());

  const double store = isTraced(method) ? 0 : 2 + texelsOf(method) * texelsOf(method) / 1e6;
  const double shade = isTraced(method) ? 180 : 9;
  for (const auto& [name, ms] : std::initializer_list<std::pair<const char*, double>>{
           {"gbuffer", 12}, {"analyze", method.name() == "dv" ? 4 : 0}, {"store", store}, {"shade", shade}}) {
    if (ms == 0) continue;
    v1::Pass& pass = *result.add_passes();
    pass.set_name(name);
    pass.set_gpu_ms(ms);
    pass.add_quartiles(ms * 0.95);
    pass.add_quartiles(ms * 1.1);
    (*pass.mutable_work())["fragments"] = 1000;
    result.set_frame_ms(result.frame_ms() + ms);
  }
  for (const double factor : {0.94, 1.12}) {
    result.add_frame_quartiles(result.frame_ms() * factor);
    result.add_ratio_quartiles(result.frame_ms() / 27 * factor);
  }
  result.set_ratio_to_baseline(result.frame_ms() / 27);
  return result;
}

}  // namespace sundial::test
