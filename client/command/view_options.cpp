#include "command/view_options.h"

#include <fmt/format.h>

#include <google/protobuf/util/message_differencer.h>

#include "command/failure.h"

namespace sundial::command {
namespace {

using google::protobuf::util::MessageDifferencer;

bool isZero(const v1::Vec3& v) { return v.x() == 0 && v.y() == 0 && v.z() == 0; }

v1::Vec3 cross(const v1::Vec3& a, const v1::Vec3& b) {
  v1::Vec3 product;
  product.set_x(a.y() * b.z() - a.z() * b.y());
  product.set_y(a.z() * b.x() - a.x() * b.z());
  product.set_z(a.x() * b.y() - a.y() * b.x());
  return product;
}

v1::Vec3 difference(const v1::Vec3& a, const v1::Vec3& b) {
  v1::Vec3 result;
  result.set_x(a.x() - b.x());
  result.set_y(a.y() - b.y());
  result.set_z(a.z() - b.z());
  return result;
}

}  // namespace

void ViewOptions::addTo(CLI::App& app, const std::string& size) {
  size_ = size;
  const std::string view = "View";
  auto* eye = app.add_option("--eye", eye_, "camera position, metres")->type_name("X,Y,Z")->group(view);
  auto* target =
      app.add_option("--target", target_, "point to look at, metres")->type_name("X,Y,Z")->group(view);
  auto* up = app.add_option("--up", up_, "direction that is up in the picture [0,1,0]")
                 ->type_name("X,Y,Z")
                 ->group(view);
  auto* fov = app.add_option("--fov", fov_, "vertical field of view, between 0 and 180 [60]")
                  ->type_name("DEGREES")
                  ->group(view);
  auto* name =
      app.add_option("--view", viewName_, "a view of the scene by its name")->type_name("NAME")->group(view);
  app.add_option("--size", size_, "pixels of the picture [" + size + "]")->type_name("WxH")->group(view);
  eye->needs(target);
  target->needs(eye);
  up->needs(eye);
  fov->needs(eye);
  name->excludes(eye);

  const std::string light = "Light";
  auto* sun = app.add_option("--sun", sun_, "direction in which the sun's light travels")
                  ->type_name("X,Y,Z")
                  ->group(light);
  auto* spot = app.add_option("--spot", spot_, "position, target and full cone angle")
                   ->type_name("EX,EY,EZ,TX,TY,TZ,DEGREES")
                   ->group(light);
  auto* point =
      app.add_option("--point", point_, "position of a point light")->type_name("X,Y,Z")->group(light);
  auto* lightName = app.add_option("--light", lightName_, "a light of the scene by its name")
                        ->type_name("NAME")
                        ->group(light);
  sun->excludes(spot)->excludes(point)->excludes(lightName);
  spot->excludes(point)->excludes(lightName);
  point->excludes(lightName);
}

void ViewOptions::apply(v1::RenderRequest& request) const {
  const Size size = parseSize("--size", size_);
  request.set_width(size.width);
  request.set_height(size.height);
  applyView(request);
  applyLight(request);
}

void ViewOptions::applyView(v1::RenderRequest& request) const {
  if (!viewName_.empty()) request.set_view_name(viewName_);
  if (eye_.empty()) return;
  v1::View& view = *request.mutable_view();
  *view.mutable_eye() = parseVec3("--eye", eye_);
  *view.mutable_target() = parseVec3("--target", target_);
  *view.mutable_up() = parseVec3("--up", up_.empty() ? "0,1,0" : up_);
  view.set_vertical_fov_degrees(parseNumbers("--fov", fov_.empty() ? "60" : fov_, 1)[0]);
  if (MessageDifferencer::Equals(view.eye(), view.target()))
    throw refusal(fmt::format("--target: it is the eye, {}; choose another point", target_));
  if (isZero(cross(difference(view.target(), view.eye()), view.up())))
    throw refusal("--up: it is parallel to the direction of the view, or zero; add e.g. --up 0,0,1");
  if (view.vertical_fov_degrees() <= 0 || view.vertical_fov_degrees() >= 180)
    throw refusal(fmt::format("--fov: {} is not between 0 and 180 degrees", fov_));
}

void ViewOptions::applyLight(v1::RenderRequest& request) const {
  if (!lightName_.empty()) request.set_light_name(lightName_);
  if (!sun_.empty()) {
    *request.mutable_light()->mutable_sun()->mutable_direction() = parseVec3("--sun", sun_);
    if (isZero(request.light().sun().direction()))
      throw refusal("--sun: 0,0,0 is no direction; try -0.5,-0.8,0.3");
  }
  if (!point_.empty())
    *request.mutable_light()->mutable_point()->mutable_position() = parseVec3("--point", point_);
  if (!spot_.empty()) {
    const auto numbers = parseNumbers("--spot", spot_, 7);
    v1::Light::Spot& spot = *request.mutable_light()->mutable_spot();
    const auto set = [&](v1::Vec3& vector, std::size_t first) {
      vector.set_x(numbers[first]);
      vector.set_y(numbers[first + 1]);
      vector.set_z(numbers[first + 2]);
    };
    set(*spot.mutable_eye(), 0);
    set(*spot.mutable_target(), 3);
    spot.set_cone_degrees(numbers[6]);
    if (MessageDifferencer::Equals(spot.eye(), spot.target()))
      throw refusal("--spot: its target is its position; choose another point");
    if (spot.cone_degrees() <= 0 || spot.cone_degrees() > 170)
      throw refusal(fmt::format("--spot: a cone of {} degrees; it is more than 0 and at most 170",
                                spot.cone_degrees()));
  }
}

}  // namespace sundial::command
