#include "tools/report/plot_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace strata::tools::report {

namespace {

constexpr int kMostDecadeTics = 9;  // on a log axis

std::string number(double x) { return fmt::format("{:.17g}", x); }

std::string bound(const std::optional<double>& value) { return value ? number(*value) : "*"; }

std::string block_name(std::size_t panel, std::size_t series) { return fmt::format("$panel{}series{}", panel, series); }

bool has_points(PlotStyle style) { return style == PlotStyle::points || style == PlotStyle::line_points; }

// Whether each point has a size of its own in the data.
bool has_sizes(const PlotSeries& series) {
    return series.style == PlotStyle::discs || (has_points(series.style) && !series.point_size.empty());
}

// The lower end of an error bar; on a log axis it stays visible.
double lower_end(const PlotSeries& series, std::size_t i, bool log) {
    const double end = series.y[i] - series.y_error[i];
    return log ? std::max(end, 0.1 * series.y[i]) : end;
}

// x y [low high] [point size], a line each.
std::string data_block(const PlotPanel& panel, std::size_t panel_index, std::size_t series_index) {
    const PlotSeries& series = panel.series[series_index];
    std::string text = block_name(panel_index, series_index) + " << EOD\n";
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        text += fmt::format("{:.17g} {:.17g}", series.x[i], series.y[i]);
        if (!series.y_error.empty()) {
            text += fmt::format(" {:.17g} {:.17g}", lower_end(series, i, panel.y.log), series.y[i] + series.y_error[i]);
        }
        if (has_sizes(series)) {
            const double size = series.point_size.empty() ? 1.0 : series.point_size[i];
            text += fmt::format(" {:.17g}", series.point_scale * size);
        }
        text += "\n";
    }
    return text + "EOD\n";
}

std::string colour_of(const PlotSeries& series, std::size_t place) {
    const auto& palette = plot_palette();
    const std::size_t index = series.colour ? static_cast<std::size_t>(std::abs(*series.colour)) : place;
    return palette[index % palette.size()];
}

int point_type(const PlotSeries& series, std::size_t place) {
    // gnuplot's numbers in the order of PlotShape: filled ones, then the cross.
    constexpr std::array kTypes{7, 6, 5, 9, 13, 2};
    constexpr std::size_t kFilled[] = {0, 2, 3, 4};
    return kTypes[series.shape ? static_cast<std::size_t>(*series.shape) : kFilled[place % std::size(kFilled)]];
}

std::string point_look(const PlotSeries& series, std::size_t place) {
    const std::string size = series.point_size.empty() ? number(series.point_scale) : "variable";
    return fmt::format(" pointtype {} pointsize {}", point_type(series, place), size);
}

const char* dash_of(PlotStyle style) {
    if (style == PlotStyle::dashed) return "dashtype 2";
    if (style == PlotStyle::dotted) return "dashtype 3";
    return "dashtype 1";
}

std::string styled(const PlotSeries& series, std::size_t place) {
    const std::string colour = gnuplot_string(colour_of(series, place));
    const std::string width = number(series.line_width);
    switch (series.style) {
        case PlotStyle::points:
            return fmt::format("with points linecolor rgb {} linewidth {}{}", colour, width, point_look(series, place));
        case PlotStyle::line_points:
            return fmt::format("with linespoints linecolor rgb {} linewidth {}{}", colour, width,
                               point_look(series, place));
        case PlotStyle::filled:
            return fmt::format("with filledcurves{} fillstyle transparent solid 0.3 noborder fillcolor rgb {}",
                               series.y_error.empty() ? " x1" : "", colour);
        case PlotStyle::discs:
            return fmt::format("with circles fillstyle solid noborder fillcolor rgb {} linecolor rgb {}", colour,
                               colour);
        default:
            return fmt::format("with lines linecolor rgb {} linewidth {} {}", colour, width, dash_of(series.style));
    }
}

std::string columns_of(const PlotSeries& series) {
    if (series.style == PlotStyle::filled && !series.y_error.empty()) return "1:3:4";
    if (!has_sizes(series)) return "1:2";
    return series.y_error.empty() ? "1:2:3" : "1:2:5";
}

// The series as drawn: its bars first, so that they lie below its points.
std::vector<std::string> plot_elements(const PlotPanel& panel, std::size_t panel_index, std::size_t place) {
    const PlotSeries& series = panel.series[place];
    const std::string block = block_name(panel_index, place);
    std::vector<std::string> elements;
    if (!series.y_error.empty() && series.style != PlotStyle::filled) {
        elements.push_back(
            fmt::format("{} using 1:2:3:4 notitle with yerrorbars linecolor rgb {} linewidth 1 pointsize 0", block,
                        gnuplot_string(colour_of(series, place))));
    }
    const std::string title = series.name.empty() ? "notitle" : "title " + gnuplot_string(series.name);
    elements.push_back(fmt::format("{} using {} {} {}", block, columns_of(series), title, styled(series, place)));
    return elements;
}

// The axis' own bounds, else those of the data.
std::pair<double, double> range_of(const PlotAxis& axis, const PlotPanel& panel, bool is_x) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const PlotSeries& series : panel.series) {
        const auto [low, high] = std::ranges::minmax(is_x ? series.x : series.y);
        least = std::min(least, low);
        most = std::max(most, high);
    }
    return {axis.min.value_or(least), axis.max.value_or(most)};
}

std::vector<PlotTic> decade_tics(std::pair<double, double> range) {
    const int first = static_cast<int>(std::floor(std::log10(range.first)));
    const int last = static_cast<int>(std::ceil(std::log10(range.second)));
    const int step = std::max(1, (last - first + kMostDecadeTics - 1) / kMostDecadeTics);
    std::vector<PlotTic> tics;
    for (int exponent = first; exponent <= last; exponent += step) {
        tics.push_back({std::pow(10.0, exponent), power_of_ten(exponent)});
    }
    return tics;
}

std::string axis_commands(const PlotAxis& axis, const PlotPanel& panel, bool is_x) {
    const char* name = is_x ? "x" : "y";
    std::string text = fmt::format("set {}label {}\n", name, gnuplot_string(axis.label));
    text += fmt::format("{} logscale {}\n", axis.log ? "set" : "unset", name);
    text += fmt::format("set {}range [{}:{}]\n", name, bound(axis.min), bound(axis.max));
    std::vector<PlotTic> tics = axis.tics;
    const auto range = range_of(axis, panel, is_x);
    // A log axis of less than two decades needs tics between powers of ten: gnuplot's.
    if (tics.empty() && axis.log && range.second >= 100 * range.first) tics = decade_tics(range);
    text += fmt::format("set {}tics autofreq\n", name);
    if (!tics.empty()) {
        std::vector<std::string> items;
        items.reserve(tics.size());
        for (const PlotTic& tic : tics) items.push_back(gnuplot_string(tic.label) + " " + number(tic.at));
        text += fmt::format("set {}tics ({})\n", name, fmt::join(items, ", "));
    }
    if (axis.grid)
        text += fmt::format("set grid {}tics linetype 1 linecolor rgb '#cccccc' linewidth 1 dashtype 1\n", name);
    return text;
}

std::string marker_commands(const PlotMarker& marker) {
    const std::string at = number(marker.at);
    const bool vertical = marker.kind == PlotMarker::Kind::vertical;
    const auto place = [&](double along) {
        return vertical ? fmt::format("first {}, graph {}", at, number(along))
                        : fmt::format("graph {}, first {}", number(along), at);
    };
    std::string text =
        fmt::format("set arrow from {} to {} nohead back linecolor rgb '#444444' linewidth 1 dashtype {}\n", place(0),
                    place(1), marker.dashed ? 2 : 1);
    if (!marker.label.empty()) {
        text += fmt::format("set label {} at {} {} front textcolor rgb '#222222'\n", gnuplot_string(marker.label),
                            place(marker.label_at),
                            vertical ? "left offset character 0.5,0" : "right offset character 0,0.5");
    }
    return text;
}

const char* legend_command(PlotLegend legend) {
    switch (legend) {
        case PlotLegend::none:
            return "unset key\n";
        case PlotLegend::top_left:
            return "set key inside left top Left reverse vertical\n";
        case PlotLegend::top_right:
            return "set key inside right top Left reverse vertical\n";
        case PlotLegend::bottom_left:
            return "set key inside left bottom Left reverse vertical\n";
        case PlotLegend::bottom_right:
            return "set key inside right bottom Left reverse vertical\n";
        case PlotLegend::below:
            return "set key outside bottom center Left reverse horizontal\n";
        case PlotLegend::right:
            return "set key outside right top Left reverse vertical\n";
    }
    return "";
}

std::string panel_commands(const PlotPanel& panel, std::size_t index) {
    std::string text = "unset grid\nunset arrow\nunset label\n";
    text += fmt::format("set title {}\n", gnuplot_string(panel.title));
    text += fmt::format("set size {}\n", panel.equal_scale ? "ratio -1" : "noratio");
    text += axis_commands(panel.x, panel, true) + axis_commands(panel.y, panel, false);
    for (const PlotMarker& marker : panel.markers) text += marker_commands(marker);
    text += legend_command(panel.legend);
    std::vector<std::string> elements;
    for (std::size_t place = 0; place < panel.series.size(); ++place) {
        for (std::string& element : plot_elements(panel, index, place)) elements.push_back(std::move(element));
    }
    return text + fmt::format("plot {}\n", fmt::join(elements, ", \\\n     "));
}

std::string terminal(const Plot& plot, PlotFormat format) {
    return fmt::format("set terminal {} size {},{} font 'DejaVu Sans,{}' noenhanced background '#ffffff'\n",
                       format == PlotFormat::png ? "pngcairo" : "svg", plot.width, plot.height, plot.font_size);
}

}  // namespace

std::string gnuplot_string(std::string_view text) {
    std::string result(1, '\'');
    for (const char c : text) {
        if (c == '\'') result += '\'';
        const auto code = static_cast<unsigned char>(c);
        result += code < 0x20 || code == 0x7f ? ' ' : c;
    }
    result += '\'';
    return result;
}

std::string power_of_ten(int exponent) {
    constexpr std::array kDigits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    if (exponent == 0) return "1";
    if (exponent == 1) return "10";
    std::string text = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[static_cast<std::size_t>(digit - '0')];
    return text;
}

std::string plot_script(const Plot& plot, PlotFormat format, std::string_view output) {
    std::string text = "set encoding utf8\n" + terminal(plot, format);
    text += fmt::format("set output {}\n", gnuplot_string(output));
    for (std::size_t panel = 0; panel < plot.panels.size(); ++panel) {
        for (std::size_t series = 0; series < plot.panels[panel].series.size(); ++series) {
            text += data_block(plot.panels[panel], panel, series);
        }
    }
    text += "set border linecolor rgb '#444444'\n";
    const std::size_t columns = static_cast<std::size_t>(plot.columns);
    const std::size_t rows = (plot.panels.size() + columns - 1) / columns;
    text += fmt::format("set multiplot layout {},{} rowsfirst", rows, columns);
    if (!plot.title.empty())
        text += fmt::format(" title {} font ',{}'", gnuplot_string(plot.title), plot.font_size + 2);
    text += "\n";
    for (std::size_t panel = 0; panel < plot.panels.size(); ++panel) text += panel_commands(plot.panels[panel], panel);
    return text + "unset multiplot\nunset output\n";
}

}  // namespace strata::tools::report
