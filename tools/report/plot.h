// Plots: data and how to show them, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace strata::tools::report {

// A plot that cannot be drawn. what() names the panel, the series and the value.
class PlotError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// filled: the area between the curve and the bottom of the panel; with y_error, the band y - y_error .. y + y_error.
// discs: filled circles whose radii, in units of the x axis, are point_scale times point_size.
enum class PlotStyle { line, dashed, dotted, points, line_points, filled, discs };

enum class PlotShape { dot, circle, square, triangle, diamond, cross };

struct PlotSeries {
    std::string name;  // in the legend; empty: not there
    std::vector<double> x, y;
    std::vector<double> y_error;     // half the height of a bar; empty: none. On a log axis bars end above zero
    std::vector<double> point_size;  // of each point, 1 being point_scale; empty: all 1
    PlotStyle style = PlotStyle::line;
    std::optional<int> colour;         // of plot_palette(), counted round; default the series' place in its panel
    std::optional<PlotShape> shape{};  // default by the series' place
    double line_width = 2.0;
    double point_scale = 1.0;
};

struct PlotTic {
    double at = 0;
    std::string label;
};

struct PlotAxis {
    std::string label;  // with its unit
    bool log = false;
    std::optional<double> min, max;  // default by the data
    std::vector<PlotTic> tics{};     // default: gnuplot's on a linear axis, powers of ten on a log one
    bool grid = true;
};

// A line across the panel.
struct PlotMarker {
    enum class Kind { vertical, horizontal };
    Kind kind = Kind::vertical;
    double at = 0;  // on the axis that it crosses
    std::string label;
    bool dashed = true;
    // Where along the line the label stands, 0 to 1 from the bottom or left.
    double label_at = 0.96;
};

enum class PlotLegend { none, top_left, top_right, bottom_left, bottom_right, below, right };

struct PlotPanel {
    std::string title;
    PlotAxis x, y;
    std::vector<PlotSeries> series;
    std::vector<PlotMarker> markers;
    PlotLegend legend = PlotLegend::top_right;
    bool equal_scale = false;  // a unit of x as long as a unit of y
};

// Panels in rows of `columns`, row by row.
struct Plot {
    std::string title;
    int columns = 1;
    std::vector<PlotPanel> panels;
    int width = 1200;  // px
    int height = 700;  // px
    int font_size = 13;
};

// Okabe and Ito's colours (2008), told apart by all common kinds of colour vision, as "#rrggbb"; the faint yellow last.
const std::vector<std::string>& plot_palette();

// Throws PlotError for a plot without panels, a panel without series, an empty series, spans of unequal length, values
// that are not finite, and values that are not positive on a log axis.
void check_plot(const Plot& plot);

// The bytes of the plot as PNG or SVG, by the extension of `path`; equal plots are equal bytes. Throws PlotError and
// ProcessError: gnuplot is not there or failed.
std::vector<unsigned char> draw_plot(const Plot& plot, const std::filesystem::path& path);

// Puts them in place whole. Throws ImageError, too: the file cannot be written.
void write_plot(const Plot& plot, const std::filesystem::path& path);

// Throws ProcessError when gnuplot is not there.
void check_plotter();

}  // namespace strata::tools::report
