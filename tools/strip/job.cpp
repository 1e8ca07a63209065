#include "tools/strip/job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "src/image/canvas.h"
#include "src/image/encode.h"
#include "src/image/file_paths.h"
#include "src/image/image_error.h"
#include "src/image/metadata.h"
#include "src/image/output_file.h"
#include "src/image/stream_target.h"
#include "src/image/text.h"
#include "src/scene/key_text.h"
#include "src/scene/printer.h"
#include "src/scene/typed_number.h"
#include "tools/cli/errors.h"
#include "tools/cli/standard_output.h"
#include "tools/cli/stream_input.h"
#include "tools/job/column_settings.h"
#include "tools/job/foreign_picture.h"
#include "tools/job/picture_labels.h"

namespace strata::tools::strip {

namespace {

namespace fs = std::filesystem;

constexpr int kMostColumns = 64;
constexpr int kPanelWidth = 256;  // that the automatic zoom keeps to

Source from_file(const std::string& typed, bool quiet) {
    const auto spooled = cli::spool_stream(typed);
    const fs::path path = spooled.value_or(typed);
    job::ForeignPicture picture = job::read_foreign_picture(path, typed, quiet);
    return {.name = typed,
            .label = typed == "-" ? "stdin" : fs::path(typed).stem().string(),
            .file = path,
            .scene = std::move(picture.scene),
            .picture = std::move(picture.linear)};
}

Source from_settings(const cli::LoadedScene& loaded, const job::ColumnSettings& settings, const char* origin) {
    return {.name = settings.text,
            .label = settings.label,
            .file = {},
            .scene = job::with_settings(loaded.scene, settings, origin),
            .picture = {}};
}

void require(bool condition, const char* message) {
    if (!condition) throw cli::UsageError(message);
}

std::vector<Source> find_columns(const Request& request, const std::optional<cli::LoadedScene>& loaded) {
    std::vector<Source> columns;
    for (const std::string& path : request.pictures) columns.push_back(from_file(path, request.quiet));
    std::vector<std::optional<scene::Scene>> scenes;
    std::vector<std::string> names;
    for (const Source& column : columns) {
        scenes.push_back(column.scene);
        names.push_back(column.label);
    }
    const std::vector<std::string> labels = job::labels_of(scenes, names);
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].label = labels[i];
    if (loaded) {
        for (const job::ColumnSettings& settings : job::parse_columns("--columns", request.columns))
            columns.push_back(from_settings(*loaded, settings, "--columns"));
    }
    if (columns.size() > kMostColumns)
        throw cli::UsageError(fmt::format("{} pictures: allowed: at most {} in a strip", columns.size(), kMostColumns));
    return columns;
}

void replace_labels(const std::string& text, std::vector<Source>& columns) {
    if (text.empty()) return;
    std::vector<std::string> labels(1);
    for (const char c : text) {
        if (c == ';')
            labels.emplace_back();
        else if (c != ' ' || !labels.back().empty())
            labels.back() += c;
    }
    if (labels.size() != columns.size())
        throw cli::UsageError(fmt::format("--labels {}: {} labels for {} pictures, allowed: one each, between ';'",
                                          scene::excerpt(text), labels.size(), columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].label = labels[i];
}

// A column by its number or its words, a file, or settings to be rendered.
void find_reference(const Request& request, const std::optional<cli::LoadedScene>& loaded, Job& job) {
    const std::string& text = request.reference;
    if (text.empty()) {
        require(!request.difference && !request.rmse,
                "--difference and --rmse need --reference: the number of a column, a picture, or settings");
        return;
    }
    if (const auto number = scene::typed_integer<int>(text)) {
        if (*number < 1 || *number > static_cast<int>(job.columns.size()))
            throw cli::UsageError(fmt::format("--reference {}: allowed: column 1 to {}", text, job.columns.size()));
        job.reference_column = static_cast<std::size_t>(*number - 1);
        return;
    }
    const auto named = [&](const Source& column) { return column.name == text || column.label == text; };
    const auto column = std::ranges::find_if(job.columns, named);
    if (column != job.columns.end()) {
        job.reference_column = static_cast<std::size_t>(column - job.columns.begin());
        return;
    }
    std::error_code ignored;
    if (!loaded || fs::exists(text, ignored) || fs::path(text).has_extension())
        job.reference = from_file(text, request.quiet);
    else
        job.reference = from_settings(*loaded, job::parse_column("--reference", text), "--reference");
}

struct Extent {
    int frame_width, frame_height;
    film::Rect window;
};

Extent extent_of(const Source& source) {
    if (!source.file.empty()) {
        const image::Picture& p = source.picture;
        return {p.frame_width, p.frame_height, {p.x0, p.y0, p.x1, p.y1}};
    }
    const scene::Film& film = source.scene->film;
    return {film.width, film.height, {0, 0, film.width, film.height}};
}

image::Picture cut(const image::Picture& whole, const film::Rect& w) {
    image::Picture part{whole.frame_width, whole.frame_height, w.x0, w.y0, w.x1, w.y1, {}};
    const std::size_t count = 3 * static_cast<std::size_t>(w.width());
    for (int y = w.y0; y < w.y1; ++y) {
        const std::size_t first =
            3 * (static_cast<std::size_t>(y - whole.y0) * static_cast<std::size_t>(whole.width()) +
                 static_cast<std::size_t>(w.x0 - whole.x0));
        const auto row = whole.rgb.begin() + static_cast<std::ptrdiff_t>(first);
        part.rgb.insert(part.rgb.end(), row, row + static_cast<std::ptrdiff_t>(count));
    }
    return part;
}

// Without --crop crops compare by their pixels, wherever they lie; with it all must have the same frame.
void require_equal_sizes(const Source& first, const Source& other, bool has_crop) {
    const Extent a = extent_of(first), b = extent_of(other);
    const bool equal = has_crop ? a.frame_width == b.frame_width && a.frame_height == b.frame_height
                                : a.window.width() == b.window.width() && a.window.height() == b.window.height();
    if (equal) return;
    const auto size = [&](const Extent& e) {
        return has_crop ? fmt::format("{}x{}", e.frame_width, e.frame_height)
                        : fmt::format("{}x{}", e.window.width(), e.window.height());
    };
    throw cli::UsageError(fmt::format("pictures of different size: {} has {} pixels, {} has {}; allowed: equal sizes",
                                      first.name, size(a), other.name, size(b)));
}

void apply_crop(const Request& request, Job& job) {
    std::vector<Source*> sources;
    for (Source& column : job.columns) sources.push_back(&column);
    if (job.reference) sources.push_back(&*job.reference);
    const bool has_crop = !request.crop.empty();
    for (const Source* source : sources) require_equal_sizes(*sources.front(), *source, has_crop);

    const Extent first = extent_of(*sources.front());
    job.frame_width = first.frame_width;
    job.frame_height = first.frame_height;
    job.window = first.window;
    if (has_crop) {
        scene::Film frame;
        frame.width = first.frame_width;
        frame.height = first.frame_height;
        job.window = cli::parse_crop("--crop", request.crop, frame);
    }
    const film::Rect& w = job.window;
    for (Source* source : sources) {
        if (source->file.empty() || !has_crop) continue;
        const film::Rect has = extent_of(*source).window;
        if (w.x0 < has.x0 || w.y0 < has.y0 || w.x1 > has.x1 || w.y1 > has.y1)
            throw cli::UsageError(fmt::format("--crop {}: {} holds pixels {},{},{},{} alone", request.crop,
                                              source->name, has.x0, has.y0, has.x1, has.y1));
        source->picture = cut(source->picture, w);
    }
}

std::optional<double> parse_top(const std::string& text) {
    if (text.empty()) return std::nullopt;
    const auto value = scene::typed_number(text);
    if (!value || !(*value > 0))
        throw cli::UsageError(fmt::format("--difference-top {}: allowed: a radiance above 0", scene::excerpt(text)));
    return value;
}

std::string default_caption(const Job& job) {
    const film::Rect& w = job.window;
    std::string text = w == film::Rect{0, 0, job.frame_width, job.frame_height}
                           ? fmt::format("{}×{} pixels", w.width(), w.height())
                           : fmt::format("Pixels {} to {} across and {} to {} down of {}×{}", w.x0, w.x1, w.y0, w.y1,
                                         job.frame_width, job.frame_height);
    if (job.zoom > 1) text += fmt::format(", each shown as {}×{}", job.zoom, job.zoom);
    return text + ".";
}

// An overscan EXR of another program, whose pixels lie outside its frame, can be shown but not be a part.
void check_part(const Job& job, const Source& source, const fs::path& path) {
    image::check_writable(path);
    const film::Rect& w = job.window;
    const image::PictureShape rendered{job.frame_width, job.frame_height, w.x0, w.y0, w.x1, w.y1};
    try {
        image::check_encodable(path, source.file.empty() ? rendered : source.picture.shape(), {}, {});
    } catch (const image::ImageError& error) {
        throw cli::UsageError(fmt::format("--parts: {}: {}; allowed: a --crop inside the frame, or no --parts",
                                          source.name, error.what()));
    }
}

void check_outputs(const Job& job) {
    try {
        image::check_canvas_format(job.output);
    } catch (const image::ImageError& error) {
        throw cli::UsageError(error.what());
    }
    image::check_writable(job.output);
    if (!job.parts) return;
    for (std::size_t i = 0; i < job.columns.size(); ++i) check_part(job, job.columns[i], part_path(job, i));
    if (job.reference) check_part(job, *job.reference, part_path(job, std::nullopt));
}

// Nothing that is read is written over.
void check_inputs_stay(const Job& job) {
    const std::vector<fs::path> outputs = strip_files(job);
    std::vector<fs::path> inputs;
    for (const Source& column : job.columns) inputs.push_back(column.file);
    if (job.reference) inputs.push_back(job.reference->file);
    for (const fs::path& input : inputs) {
        for (const fs::path& output : outputs) {
            if (!input.empty() && image::is_one_file(input, output))
                throw cli::UsageError(fmt::format("{}: this output is a picture of the strip", output.string()));
        }
    }
}

}  // namespace

fs::path part_path(const Job& job, std::optional<std::size_t> i) {
    const std::string which = i ? fmt::format("{:0{}}", *i + 1, job.columns.size() > 9 ? 2 : 1) : "reference";
    const fs::path sheet = image::stream_target(job.output) ? fs::path("strip.png") : job.output;
    return image::derived_path(sheet, fmt::format("-{}.exr", which));
}

std::vector<fs::path> strip_files(const Job& job) {
    std::vector<fs::path> files{job.output};
    if (!job.parts) return files;
    for (std::size_t i = 0; i < job.columns.size(); ++i) files.push_back(part_path(job, i));
    if (job.reference) files.push_back(part_path(job, std::nullopt));
    return files;
}

Job prepare_strip(const Request& request) {
    require(!request.pictures.empty() || request.has_scene, "nothing to show: give pictures, or --scene and --columns");
    require(request.has_scene == !request.columns.empty(), "--scene and --columns go together");
    Job job;
    job.quiet = request.quiet;
    job.threads = request.threads;
    std::optional<cli::LoadedScene> loaded;
    if (request.has_scene) loaded = request.scene.load();
    job.columns = find_columns(request, loaded);
    replace_labels(request.labels, job.columns);
    find_reference(request, loaded, job);
    apply_crop(request, job);
    job.zoom = request.zoom.value_or(std::clamp(kPanelWidth / job.window.width(), 1, 16));
    job.top = parse_top(request.top);
    job.difference = request.difference;
    job.rmse = request.rmse;
    job.parts = request.parts;
    const auto& first_scene = job.columns.front().scene;
    const scene::Film* film = loaded ? &loaded->scene.film : first_scene ? &first_scene->film : nullptr;
    if (film) job.colour = image::colour_out(*film);
    job.title = request.title.value_or(loaded ? loaded->scene.title : "");
    job.caption = request.caption.value_or(default_caption(job));
    if (loaded) job.scene_text = scene::print_scene(loaded->scene);
    job.output = request.output.empty() ? fs::path("strip.png") : fs::path(request.output);
    const auto stream = image::stream_target(job.output);
    if (stream && !stream->format) job.output = "png:" + job.output.string();
    cli::keep_output_for(job.output);
    check_outputs(job);
    check_inputs_stay(job);
    image::check_fonts();
    return job;
}

}  // namespace strata::tools::strip
