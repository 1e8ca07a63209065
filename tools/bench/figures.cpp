#include "tools/bench/figures.h"

#include <fmt/format.h>

#include <algorithm>

namespace strata::tools::bench {

namespace {

constexpr double kReferenceNs = 35;  // an evaluation of the reference may cost so much for its ratio to count

// Time by the clock over CPU time of one thread, above which others took a part of the processor.
constexpr double kBusy = 1.03;

using Quantity = std::optional<double>;

Quantity operator/(const Quantity& a, const Quantity& b) {
    if (!a || !b || *b == 0) return std::nullopt;
    return *a / *b;
}

class Maker {
  public:
    explicit Maker(const Results& results) : results_(results), cases_(results.plan.figures) {}

    std::vector<Figure> all();

  private:
    const Measurement* measured(const std::string& id) const { return find(results_.measurements, id); }

    Quantity ns(const std::string& id, Pick pick) const {
        const Measurement* found = measured(id);
        return found ? Quantity(found->ns_a_ray(pick)) : std::nullopt;
    }
    Quantity wall(const std::string& id, Pick pick) const {
        const Measurement* found = measured(id);
        return found ? Quantity(pick_of(found->wall_s, pick)) : std::nullopt;
    }
    Quantity peer_ns(const char* id, Pick pick) const {
        const PeerResult* peer = find_peer(results_, id);
        return peer && !peer->ns_a_ray.empty() ? Quantity(pick_of(peer->ns_a_ray, pick)) : std::nullopt;
    }
    Quantity shadow_ray(Pick pick) const;

    // value(pick) is taken twice: of the least times and of their medians.
    template <class Value>
    void add(Figure figure, const char* section, const Value& value) {
        figure.value = value(Pick::least);
        figure.of_medians = value(Pick::median);
        if (!figure.value && figure.note.empty()) figure.note = fmt::format("--only {}", section);
        figures_.push_back(std::move(figure));
    }
    void add_count(Figure figure, const char* section, const Quantity& value) {
        figure.value = value;
        if (!value) figure.note = fmt::format("--only {}", section);
        figures_.push_back(std::move(figure));
    }

    void against_reference();
    void against_itself();
    void against_peers();
    void memory();

    const Results& results_;
    const FigureCases& cases_;
    std::vector<Figure> figures_;
};

void Maker::against_reference() {
    const Measurement* main = measured(cases_.main);
    add_count({.name = "evaluations",
               .meaning = "noise evaluations a ray, all phases",
               .floor = 40,
               .aim = 16,
               .note = main ? fmt::format("{}, {}", cases_.main, main->what.subset.text()) : ""},
              "figures", main ? Quantity(main->evaluations_a_ray()) : std::nullopt);
    const Measurement* reference = measured(cases_.reference);
    add({.name = "reference",
         .meaning = "ns a ray against the reference tracer's",
         .floor = 1.0 / 80,
         .aim = 1.0 / 400,
         .form = FigureForm::reciprocal,
         .note =
             reference ? fmt::format("the reference: {:.0f} evaluations a ray", reference->evaluations_a_ray()) : ""},
        "figures", [&](Pick pick) { return ns(cases_.main, pick) / ns(cases_.reference, pick); });
    add({.name = "reference ns", .meaning = "ns an evaluation of the reference tracer", .floor = kReferenceNs},
        "reference", [&](Pick pick) { return reference ? Quantity(reference->ns_an_evaluation(pick)) : std::nullopt; });
}

// The same pixels with shadow rays and without: what is more is theirs.
Quantity Maker::shadow_ray(Pick pick) const {
    const Measurement *with = measured(cases_.shadows), *without = measured(cases_.main);
    if (!with || !without || with->counters.shadow_rays == 0) return std::nullopt;
    const double more_s = pick_of(with->cpu_s, pick) - pick_of(without->cpu_s, pick);
    return 1e9 * more_s / static_cast<double>(with->counters.shadow_rays);
}

void Maker::against_itself() {
    const auto ratio = [&](const char* name, const char* meaning, double floor, Quantity aim, const std::string& first,
                           const std::string& second) {
        add({.name = name, .meaning = meaning, .floor = floor, .aim = aim}, "figures",
            [&](Pick pick) { return ns(first, pick) / ns(second, pick); });
    };
    add({.name = "shadow ray", .meaning = "a shadow ray's cost against a primary ray's", .floor = 1.5, .aim = 0.7},
        "figures", [&](Pick pick) { return shadow_ray(pick) / ns(cases_.main, pick); });
    ratio("octaves", "16 octaves against 8", 1.5, 1.15, cases_.octaves, cases_.main);
    ratio("2-D noise", "height field of 2-D noise against 3-D", 0.6, 0.4, cases_.planar, cases_.main);
    ratio("samples", "a ray at the largest N against one at N = 2", 0.5, 0.3, cases_.main, cases_.few_samples);
    ratio("turning", "turning planet, open shutter, against at rest", 3, {}, cases_.spin_moving, cases_.spin_still);
    ratio("flying", "moving camera, open shutter, against at rest", 3, {}, cases_.camera_moving, cases_.camera_still);
    const Measurement* one = measured(cases_.one_thread);
    const double busy = one ? pick_of(one->wall_s, Pick::least) / pick_of(one->cpu_s, Pick::least) : 1;
    add({.name = "threads",
         .meaning = "two threads' speed against one's, by the clock",
         .floor = 1.9,
         .aim = 1.97,
         .more_is_better = true,
         .note =
             busy > kBusy ? fmt::format("the machine had other work: by the clock {:.2f} of the CPU time", busy) : ""},
        "threads, two cores",
        [&](Pick pick) { return wall(cases_.one_thread, pick) / wall(cases_.two_threads, pick); });
}

void Maker::against_peers() {
    const auto povray = [&](const char* name, const char* meaning, double floor, double aim, const char* peer) {
        add({.name = name, .meaning = meaning, .floor = floor, .aim = aim, .form = FigureForm::reciprocal}, "peers",
            [&](Pick pick) { return ns(cases_.main, pick) / peer_ns(peer, pick); });
    };
    povray("POV-Ray", "ns a ray against POV-Ray's isosurface, guaranteed", 1.0 / 150, 1.0 / 700, kPovrayGuaranteed);
    add({.name = "Embree",
         .meaning = "ns a ray against Embree's rtcIntersect1, 2048² mesh",
         .floor = 4,
         .aim = 1,
         .note = find_peer(results_, kEmbreeOne) ? "both at 16 samples a pixel" : ""},
        "peers", [&](Pick pick) { return ns(cases_.peer_samples, pick) / peer_ns(kEmbreeOne, pick); });
}

void Maker::memory() {
    const auto peak = [&](const char* name, const char* id, double floor, double aim) {
        Quantity value;
        std::string note;
        for (const MemoryResult& row : results_.memory) {
            if (row.id == id && row.peak_bytes > 0) value = static_cast<double>(row.peak_bytes);
            if (row.id == id && row.peak_bytes == 0) note = "the render failed";
        }
        add_count({.name = name,
                   .meaning = fmt::format("peak memory of a render at {}", id),
                   .floor = floor,
                   .aim = aim,
                   .form = FigureForm::megabytes},
                  "memory", value);
        if (!note.empty()) figures_.back().note = note;
    };
    peak("memory", kMemoryUsual, 200e6, 100e6);
    peak("memory, huge", kMemoryHuge, 1e9, 300e6);
}

std::vector<Figure> Maker::all() {
    against_reference();
    against_peers();
    against_itself();
    memory();
    return std::move(figures_);
}

}  // namespace

const PeerResult* find_peer(const Results& results, const std::string& id) {
    const auto found = std::ranges::find(results.peers, id, &PeerResult::id);
    return found == results.peers.end() ? nullptr : &*found;
}

Verdict Figure::verdict() const {
    if (!value) return Verdict::not_measured;
    const auto reaches = [&](double mark) { return more_is_better ? *value >= mark : *value <= mark; };
    if (aim && reaches(*aim)) return Verdict::aim;
    return reaches(floor) ? Verdict::floor : Verdict::below;
}

std::string Figure::text(double number) const {
    if (form == FigureForm::megabytes) return fmt::format("{:.0f} MB", number / 1e6);
    if (form == FigureForm::reciprocal && number > 0 && number < 0.5) {
        return fmt::format("1/{:.{}f}", 1 / number, number > 0.1 ? 1 : 0);
    }
    return fmt::format("{:.3g}", number);
}

const char* verdict_name(Verdict verdict) {
    switch (verdict) {
        case Verdict::aim:
            return "PASS, aim";
        case Verdict::floor:
            return "PASS";
        case Verdict::below:
            return "SHORT";
        case Verdict::not_measured:
            return "not measured";
    }
    return "";
}

std::vector<Figure> figures_of(const Results& results) { return Maker(results).all(); }

}  // namespace strata::tools::bench
