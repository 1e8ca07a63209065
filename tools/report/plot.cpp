#include "tools/report/plot.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <optional>
#include <system_error>

#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/output_file.h"
#include "tools/cli/process.h"
#include "tools/cli/temporary_folder.h"
#include "tools/cli/text_file.h"
#include "tools/report/plot_script.h"

namespace strata::tools::report {

namespace {

namespace fs = std::filesystem;

fs::path gnuplot() { return cli::find_program("gnuplot", "gnuplot-nox", "plot"); }

PlotFormat format_of(const fs::path& path) {
    const std::string extension = image::extension_of(path);
    if (extension == ".png") return PlotFormat::png;
    if (extension == ".svg") return PlotFormat::svg;
    throw PlotError(fmt::format("{}: allowed: a plot's name ends in .png or .svg", path.string()));
}

// Where in a plot a value stands, for messages.
std::string place_of(const PlotPanel& panel, const PlotSeries& series) {
    return fmt::format("plot '{}', series '{}'", panel.title, series.name);
}

void check_values(const std::string& place, const char* name, const std::vector<double>& values, bool positive) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i]) && (!positive || values[i] > 0)) continue;
        throw PlotError(fmt::format("{}: {}[{}] is {}, allowed: {} numbers", place, name, i, values[i],
                                    positive ? "positive, on a log axis," : "finite"));
    }
}

void check_bounds(const PlotPanel& panel, const char* name, const PlotAxis& axis) {
    for (const auto& bound : {axis.min, axis.max}) {
        if (!bound || (std::isfinite(*bound) && (!axis.log || *bound > 0))) continue;
        throw PlotError(fmt::format("plot '{}': the {} axis ends at {}", panel.title, name, *bound));
    }
    if (axis.min && axis.max && !(*axis.min < *axis.max)) {
        throw PlotError(
            fmt::format("plot '{}': the {} axis runs from {} to {}", panel.title, name, *axis.min, *axis.max));
    }
    for (const PlotTic& tic : axis.tics) {
        if (!std::isfinite(tic.at))
            throw PlotError(fmt::format("plot '{}': a {} tic at {}", panel.title, name, tic.at));
    }
}

void check_series(const PlotPanel& panel, const PlotSeries& series) {
    const std::string place = place_of(panel, series);
    if (series.x.empty()) throw PlotError(place + ": no points");
    if (series.y.size() != series.x.size()) {
        throw PlotError(fmt::format("{}: {} x for {} y", place, series.x.size(), series.y.size()));
    }
    for (const auto* extra : {&series.y_error, &series.point_size}) {
        if (!extra->empty() && extra->size() != series.x.size()) {
            throw PlotError(fmt::format("{}: {} errors or sizes for {} points", place, extra->size(), series.x.size()));
        }
    }
    check_values(place, "x", series.x, panel.x.log);
    check_values(place, "y", series.y, panel.y.log);
    check_values(place, "y_error", series.y_error, false);
    check_values(place, "point_size", series.point_size, false);
}

void check_panel(const PlotPanel& panel) {
    if (panel.series.empty()) throw PlotError(fmt::format("plot '{}': no series", panel.title));
    check_bounds(panel, "x", panel.x);
    check_bounds(panel, "y", panel.y);
    for (const PlotSeries& series : panel.series) check_series(panel, series);
    for (const PlotMarker& marker : panel.markers) {
        if (!std::isfinite(marker.at))
            throw PlotError(fmt::format("plot '{}': a marker at {}", panel.title, marker.at));
    }
}

// For gnuplot, which would draw a part of it.
void write_script(const fs::path& script, const std::string& text, const fs::path& path) {
    errno = 0;
    std::ofstream file(script, std::ios::binary);
    file << text;
    file.close();
    if (file) return;
    throw cli::ProcessError(fmt::format("cannot write \"{}\": its script in \"{}\": {}", path.string(),
                                        script.parent_path().string(),
                                        std::generic_category().message(errno != 0 ? errno : EIO)));
}

// What gnuplot has drawn for `path`.
std::vector<unsigned char> drawing(const fs::path& drawn, const fs::path& path) {
    std::string why;
    const std::optional<std::string> bytes = cli::read_text_file(drawn, why);
    if (!bytes) {
        throw cli::ProcessError(
            fmt::format("cannot write \"{}\": what gnuplot drew cannot be read: {}", path.string(), why));
    }
    if (bytes->empty()) throw cli::ProcessError("gnuplot drew nothing for " + path.string());
    return {bytes->begin(), bytes->end()};
}

}  // namespace

const std::vector<std::string>& plot_palette() {
    static const std::vector<std::string> colours{"#0072B2", "#D55E00", "#009E73", "#E69F00",
                                                  "#CC79A7", "#000000", "#56B4E9", "#F0E442"};
    return colours;
}

void check_plot(const Plot& plot) {
    if (plot.panels.empty()) throw PlotError(fmt::format("plot '{}': no panels", plot.title));
    if (plot.columns < 1 || plot.width < 1 || plot.height < 1 || plot.font_size < 1) {
        throw PlotError(fmt::format("plot '{}': its columns, size and font size must be 1 at least", plot.title));
    }
    for (const PlotPanel& panel : plot.panels) check_panel(panel);
}

std::vector<unsigned char> draw_plot(const Plot& plot, const fs::path& path) {
    const PlotFormat format = format_of(path);
    check_plot(plot);
    const fs::path program = gnuplot();
    cli::TemporaryFolder folder("plot");
    const fs::path script = folder.file("plot.gp"), drawn = folder.file("plot");
    write_script(script, plot_script(plot, format, drawn.string()), path);
    // -d: no start-up files of the user or the system.
    cli::run_program(program, {"-d", script.string()});
    return drawing(drawn, path);
}

void write_plot(const Plot& plot, const fs::path& path) { image::replace_file(path, draw_plot(plot, path)); }

void check_plotter() { gnuplot(); }

}  // namespace strata::tools::report
