// The figures that the engine is judged by, each a ratio or a count of one run, with its floor and its aim.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/bench/results.h"

namespace strata::tools::bench {

enum class FigureForm { plain, reciprocal, megabytes };  // 0.6; 1/80; 200 MB
enum class Verdict { aim, floor, below, not_measured };

struct Figure {
    std::string name;
    std::string meaning;
    std::optional<double> value{};  // by the least times; empty: not measured
    std::optional<double> of_medians{};
    double floor = 0;
    std::optional<double> aim{};
    FigureForm form = FigureForm::plain;
    bool more_is_better = false;
    std::string note{};  // what it rests on, or what to run for it

    Verdict verdict() const;
    std::string text(double number) const;  // "0.62", "1/84", "143 MB"
};

const char* verdict_name(Verdict verdict);

// All of them, those not measured too.
std::vector<Figure> figures_of(const Results& results);

}  // namespace strata::tools::bench
