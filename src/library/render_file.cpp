#include <fmt/format.h>

#include "src/image/output_file.h"
#include "src/image/picture_metadata.h"
#include "src/image/picture_stream.h"
#include "src/integrate/make_image.h"
#include "src/library/render_setting.h"
#include "src/library/translate.h"

namespace strata {

namespace {

namespace fs = std::filesystem;

// A picture on its way into a file.
class FileRender {
  public:
    FileRender(RenderSetting& setting, const fs::path& file, const FileOptions& options);

    render::ProgressiveResult run() { return setting_.goal().passes > 1 ? in_passes() : streamed(); }

  private:
    render::ProgressiveResult streamed();
    render::ProgressiveResult in_passes();
    void write(image::PictureStream& stream, std::span<const glm::vec3> pixels);
    bool is_whole(const render::RenderResult& result) const { return !result.cancelled && !setting_.callback_failed(); }

    RenderSetting& setting_;
    fs::path file_;
    image::PictureShape shape_;
    image::WriteOptions write_;
    image::Metadata metadata_;
};

FileRender::FileRender(RenderSetting& setting, const fs::path& file, const FileOptions& options)
    : setting_(setting), file_(file) {
    const scene::Film& frame = setting.scene().film;
    const film::Rect& w = setting.window();
    if (image::is_standard_output(file)) {
        throw Error(fmt::format("{}: standard output, allowed: a file", file.string()));
    }
    image::format_of(file);
    image::check_size(file, w.width(), w.height());
    image::check_writable(file);
    const bool is_half = options.exr_format == ExrFormat::half;
    shape_ = {frame.width, frame.height, w.x0, w.y0, w.x1, w.y1};
    write_ = {.colour = image::colour_out(frame),
              .exr_format = is_half ? image::ExrFormat::half : image::ExrFormat::floating,
              .exr_layout = options.tiled ? image::ExrLayout::tiles : image::ExrLayout::automatic};
    metadata_ =
        image::picture_metadata(setting.scene(), w, setting.tracer() == integrate::Tracer::fast ? "fast" : "reference",
                                is_half ? "half" : "float");
    if (options.tiled) metadata_.set("strata:tiled", "asked for");
}

void FileRender::write(image::PictureStream& stream, std::span<const glm::vec3> pixels) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    stream.write({&pixels[0].x, 3 * pixels.size()});
}

// One pass goes into its file while it is rendered.
render::ProgressiveResult FileRender::streamed() {
    const auto image = integrate::make_image(setting_.scene(), setting_.tracer());
    const estimate::Estimator estimator(estimate::estimator_settings(setting_.scene()));
    image::PictureStream stream(file_, shape_, metadata_, write_);
    render::ProgressiveResult result;
    result.render = render::render_strips(*image, estimator, setting_.window(), setting_.options(), image::kStripRows,
                                          [&](const film::Film& strip) {
                                              try {
                                                  write(stream, strip.pixels());
                                              } catch (...) {
                                                  setting_.cancel();  // nothing is left to render for
                                                  throw;
                                              }
                                          });
    result.passes = result.render.cancelled ? 0 : 1;
    if (is_whole(result.render)) stream.finish();
    return result;
}

// The mean of several passes is known at their end.
render::ProgressiveResult FileRender::in_passes() {
    const auto image = integrate::make_image(setting_.scene(), setting_.tracer());
    render::ProgressiveResult result = render::render_progressively(
        *image, estimate::estimator_settings(setting_.scene()), setting_.window(), setting_.goal(), setting_.options());
    if (!is_whole(result.render)) return result;
    image::set_passes(metadata_, setting_.scene().sampling, result.passes);
    image::PictureStream stream(file_, shape_, metadata_, write_);
    const std::span<const glm::vec3> pixels(result.render.film.pixels());
    const auto strip = static_cast<std::size_t>(shape_.width()) * image::kStripRows;
    for (std::size_t begin = 0; begin < pixels.size(); begin += strip) {
        write(stream, pixels.subspan(begin, std::min(strip, pixels.size() - begin)));
    }
    stream.finish();
    return result;
}

}  // namespace

RenderReport render_file(const Scene& scene, const fs::path& file, const RenderOptions& options,
                         const FileOptions& file_options) {
    RenderSetting setting(scene, options);
    const RenderReport report = translated([&] { return report_of(FileRender(setting, file, file_options).run()); });
    setting.rethrow_of_callback();
    return report;
}

}  // namespace strata
