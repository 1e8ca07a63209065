// The gnuplot script of a plot, data included.
#pragma once

#include <string>
#include <string_view>

#include "tools/report/plot.h"

namespace strata::tools::report {

enum class PlotFormat { png, svg };

// A whole script that draws a checked plot (check_plot) to the file `output`. All texts are shown as they are: nothing
// in them reaches gnuplot as a command or as markup.
std::string plot_script(const Plot& plot, PlotFormat format, std::string_view output);

// A gnuplot string of the text. Within single quotes gnuplot knows no escape but the doubled quote; line ends and other
// control characters become blanks.
std::string gnuplot_string(std::string_view text);

// "10⁻⁶".
std::string power_of_ten(int exponent);

}  // namespace strata::tools::report
