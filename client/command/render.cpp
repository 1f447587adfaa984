// sundial render: one picture.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "command/command.h"
#include "command/failure.h"
#include "command/json.h"
#include "command/report.h"
#include "command/view_options.h"
#include "image/encode.h"
#include "image/file.h"
#include "sundial/method_choice.h"

namespace sundial::command {
namespace {

namespace fs = std::filesystem;
constexpr int kJpegQuality = 95;

struct Options {
  std::string scene, method, output, aovs;
  ViewOptions view;
};

std::string encodePicture(const client::Image& image, image::FileType type) {
  const image::Picture picture = image::toPicture(image);
  return type == image::FileType::png ? image::encodePng(picture) : image::encodeJpeg(picture, kJpegQuality);
}

// An .exr holds everything. A picture shows one thing: the colour, or the one other image that was chosen, or
// of several each in a file of its own.
std::vector<image::OutputFile> encode(const client::MethodRendering& rendering, const fs::path& path,
                                      image::FileType type) {
  if (type == image::FileType::exr) return {{path, image::encodeExr(rendering)}};
  if (rendering.images.size() == 2) return {{path, encodePicture(rendering.images[1], type)}};
  std::vector<image::OutputFile> files;
  for (const client::Image& image : rendering.images) {
    fs::path own = path;
    if (image.aov != v1::COLOUR)
      own.replace_filename(fmt::format("{}-{}{}", path.stem().string(), client::aovName(image.aov),
                                       path.extension().string()));
    files.push_back({own, encodePicture(image, type)});
  }
  return files;
}

void render(Session& session, const Options& options) {
  // Refuse what can be refused here.
  v1::RenderRequest request;
  options.view.apply(request);
  *request.add_methods() = orRefuse(client::parseMethodChoice(options.method));
  for (const v1::Aov aov : parseAovs("--aov", options.aovs)) request.add_images(aov);
  const auto type = image::fileType(options.output);
  if (!type)
    throw refusal(
        fmt::format("-o: '{}' is no .png, .exr or .jpg; name the file with one of them", options.output));
  if (const auto why = image::whyUnwritable(options.output)) throw refusal("-o: " + *why);

  request.set_scene(session.sceneReference(options.scene));
  const client::Rendering rendering = session.render(request);
  const auto files = encode(rendering.methods.front(), options.output, *type);
  image::writeFiles(files);

  if (session.options().json)
    return printJson(
        makeReport(options.scene, request, rendering, session.answer(session.client().serverInfo())));
  if (session.options().quiet) return;
  for (const image::OutputFile& file : files) fmt::print("{}\n", file.path.string());
}

}  // namespace

void addRender(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("render", "Render one view of a scene by one method into a file");
  command->footer(
      "With --aov, an .exr holds the colour and all of the chosen images as channels. A .png or .jpg is a "
      "picture\n"
      "of the chosen image; of several, FILE is the colour and each is a file of its own: "
      "FILE-visibility.png, ...\n"
      "\nExample:\n  sundial render builtin:atrium --method sm,texels=2048 --size 1024x1024 -o atrium.png");
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, kSceneHelp)->required();
  command->add_option("--method", options->method, "see 'sundial methods'")
      ->type_name(kMethodSyntax)
      ->required();
  command->add_option("-o,--output", options->output, ".png, .exr or .jpg")->type_name("FILE")->required();
  command
      ->add_option("--aov", options->aovs,
                   "visibility,reference,position,normal,id,view,class, some of them, or all")
      ->type_name("NAMES");
  options->view.addTo(*command);
  command->callback(
      [&action, options] { action = [options](Session& session) { render(session, *options); }; });
}

}  // namespace sundial::command
