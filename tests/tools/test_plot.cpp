#include "tools/report/plot.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>

#include "src/image/read.h"
#include "tests/image/scratch_folder.h"
#include "tools/cli/process.h"
#include "tools/report/plot_script.h"

namespace {

using namespace strata;
using tools::report::Plot;
using tools::report::PlotAxis;
using tools::report::PlotError;
using tools::report::PlotFormat;
using tools::report::PlotPanel;
using tools::report::PlotSeries;
using tools::report::PlotStyle;

PlotPanel panel_of(std::vector<double> x, std::vector<double> y) {
    PlotPanel panel;
    panel.title = "A panel";
    panel.x.label = "time / s";
    panel.y.label = "error / px";
    PlotSeries series;
    series.name = "a series";
    series.x = std::move(x);
    series.y = std::move(y);
    panel.series.push_back(std::move(series));
    return panel;
}

Plot plot_of(PlotPanel panel) {
    Plot plot;
    plot.width = 480;
    plot.height = 320;
    plot.panels.push_back(std::move(panel));
    return plot;
}

std::string script_of(const Plot& plot) { return tools::report::plot_script(plot, PlotFormat::svg, "out.svg"); }

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Every feature at once, with texts that try to be commands and markup.
Plot everything() {
    Plot plot;
    plot.title = "It's a `date` \"test\" $x @y \\n {/*3 big} H_2 \n quit";
    plot.columns = 2;
    plot.width = 700;
    plot.height = 500;
    PlotPanel panel = panel_of({1, 10, 100, 1000}, {1, 0.1, 0.01, 0.001});
    panel.x.log = panel.y.log = true;
    panel.series[0].y_error = {0.5, 0.2, 0.001, 0.0005};
    for (const PlotStyle style :
         {PlotStyle::dashed, PlotStyle::dotted, PlotStyle::points, PlotStyle::line_points, PlotStyle::filled}) {
        panel.series.push_back(panel.series[0]);
        panel.series.back().style = style;
        panel.series.back().name = "Ünïcode n̂ₘ 'quoted'";
    }
    panel.series[3].point_size = {1, 2, 3, 4};
    panel.markers.push_back({.kind = tools::report::PlotMarker::Kind::vertical, .at = 50, .label = "it's \n here"});
    panel.markers.push_back({.kind = tools::report::PlotMarker::Kind::horizontal, .at = 0.05, .label = "limit"});
    panel.legend = tools::report::PlotLegend::below;
    plot.panels.assign(3, panel);
    plot.panels[1] = panel_of({0, 1}, {0, 1});
    plot.panels[1].equal_scale = true;
    plot.panels[1].x.tics = {{0, "none"}, {1, "one's"}};
    return plot;
}

}  // namespace

TEST_CASE("a gnuplot string ends nowhere but at its end, whatever the text") {
    std::string all;
    for (int code = 1; code < 256; ++code) all += static_cast<char>(code);
    for (const std::string& text : {std::string("it's"), std::string("''"), std::string("\\'"), all, std::string()}) {
        const std::string quoted = tools::report::gnuplot_string(text);
        REQUIRE(quoted.size() >= 2);
        CHECK(quoted.front() == '\'');
        CHECK(quoted.back() == '\'');
        // Inside, quotes come in pairs, and no control character is left.
        const std::string inside = quoted.substr(1, quoted.size() - 2);
        CHECK_FALSE(holds(std::regex_replace(inside, std::regex("''"), ""), "'"));
        for (const char c : inside) CHECK(static_cast<unsigned char>(c) >= 0x20);
    }
}

TEST_CASE("the script holds every point with all its digits") {
    const double x = 0.1, y = 1.0 / 3.0;
    const std::string script = script_of(plot_of(panel_of({x, 2}, {y, -0x1p-900})));
    CHECK(holds(script, "\n0.10000000000000001 0.33333333333333331\n2 -1.1830521861667747e-271\n"));
}

TEST_CASE("texts stand in the script in single quotes, without markup") {
    const std::string script = script_of(everything());
    CHECK(holds(script, "noenhanced"));
    CHECK(holds(script, "'It''s a `date` \"test\" $x @y \\n {/*3 big} H_2   quit'"));
    CHECK_FALSE(holds(script, "\n quit"));
}

TEST_CASE("log axes get tics at powers of ten, never too many") {
    PlotPanel panel = panel_of({1e-300, 1e-3}, {1, 2});
    panel.x.log = true;
    const std::string script = script_of(plot_of(panel));
    CHECK(holds(script, "set logscale x"));
    CHECK(holds(script, "unset logscale y"));
    CHECK(holds(script, "'10⁻³⁰⁰' "));
    std::smatch tics;
    REQUIRE(std::regex_search(script, tics, std::regex("set xtics \\(([^)]*)\\)")));
    const std::string list = tics[1];
    CHECK(std::count(list.begin(), list.end(), ',') < 10);
    CHECK(tools::report::power_of_ten(-16) == "10⁻¹⁶");
    CHECK(tools::report::power_of_ten(0) == "1");
}

TEST_CASE("error bars on a log axis end above zero") {
    PlotPanel panel = panel_of({1, 2}, {1, 10});
    panel.y.log = true;
    panel.series[0].y_error = {5, 1};
    CHECK(holds(script_of(plot_of(panel)), "\n1 1 0.10000000000000001 6\n2 10 9 11\n"));
}

TEST_CASE("what cannot be drawn is an error that names the place") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = HUGE_VAL;
    const auto refused = [](const Plot& plot) {
        try {
            tools::report::check_plot(plot);
        } catch (const PlotError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refused(plot_of(panel_of({1}, {1}))).empty());
    CHECK(holds(refused(plot_of(panel_of({}, {}))), "'a series': no points"));
    CHECK(holds(refused(plot_of(panel_of({1, 2}, {1}))), "2 x for 1 y"));
    CHECK(holds(refused(plot_of(panel_of({1, 2}, {1, nan}))), "'A panel', series 'a series': y[1] is nan"));
    CHECK(holds(refused(plot_of(panel_of({infinity}, {1}))), "x[0] is inf"));
    PlotPanel log = panel_of({1, 2}, {1, 0});
    log.y.log = true;
    CHECK(holds(refused(plot_of(log)), "y[1] is 0, allowed: positive"));
    PlotPanel bars = panel_of({1, 2}, {1, 1});
    bars.series[0].y_error = {1};
    CHECK(holds(refused(plot_of(bars)), "1 errors or sizes for 2 points"));
    PlotPanel range = panel_of({1}, {1});
    range.x.min = range.x.max = 3;
    CHECK(holds(refused(plot_of(range)), "x axis runs from 3 to 3"));
    range.x.max = nan;
    CHECK(holds(refused(plot_of(range)), "x axis ends at nan"));
    PlotPanel marked = panel_of({1}, {1});
    marked.markers.push_back({.at = nan, .label = ""});
    CHECK(holds(refused(plot_of(marked)), "a marker at nan"));
    PlotPanel none = panel_of({1}, {1});
    none.series.clear();
    CHECK(holds(refused(plot_of(none)), "no series"));
    CHECK(holds(refused(Plot{}), "no panels"));
}

TEST_CASE("PNG and SVG are drawn, and equal plots are equal files") {
    const ScratchFolder folder;
    for (const char* name : {"a.png", "b.png", "a.svg", "b.svg"})
        tools::report::write_plot(everything(), folder / name);
    const std::string png = file_bytes(folder / "a.png"), svg = file_bytes(folder / "a.svg");
    CHECK(png == file_bytes(folder / "b.png"));
    CHECK(svg == file_bytes(folder / "b.svg"));
    const image::Picture picture = image::read_picture(folder / "a.png");
    CHECK(picture.width() == 700);
    CHECK(picture.height() == 500);
    const auto [darkest, lightest] = std::minmax_element(picture.rgb.begin(), picture.rgb.end());
    CHECK(*lightest == 1.0f);
    CHECK(*darkest < 0.3f);
    CHECK(holds(svg, "<svg"));
    CHECK(holds(svg, "`date`"));
    CHECK(holds(svg, "{/*3 big} H_2"));
    CHECK(holds(svg, "one's"));
    CHECK(holds(svg, "10⁻³"));
    CHECK_FALSE(std::regex_search(svg, std::regex("20[0-9][0-9]-|[0-9]:[0-9][0-9]:")));
    CHECK(folder.names() == std::vector<std::string>{"a.png", "a.svg", "b.png", "b.svg"});
}

TEST_CASE("a name that is neither PNG nor SVG and a folder that is not there are errors, and leave nothing") {
    const ScratchFolder folder;
    const Plot plot = plot_of(panel_of({1, 2}, {1, 2}));
    CHECK_THROWS_AS(tools::report::write_plot(plot, folder / "a.pdf"), PlotError);
    CHECK_THROWS(tools::report::write_plot(plot, folder / "nowhere/a.png"));
    CHECK(folder.names().empty());
}

TEST_CASE("without gnuplot the error names its package") {
    const char* path = std::getenv("PATH");
    const std::string kept = path != nullptr ? path : "";
    const ScratchFolder folder;
    setenv("PATH", folder.path().c_str(), 1);
    CHECK_THROWS_WITH_AS(tools::report::check_plotter(), doctest::Contains("gnuplot-nox"), tools::cli::ProcessError);
    setenv("PATH", kept.c_str(), 1);
}
