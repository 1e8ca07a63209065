// A relief: a scalar function of space (of the plane, over 2-D noise) put together from named terms, the last of which
// is the relief. A term is a node of some kind (nodes/) and may take terms before it as inputs.
//
// Each node's formula is written once, as a template over numbers, and read three ways: by jets in double (value and
// gradient: the reference), by bounds of the whole domain (certificate()), and by the tracers' vectors of floats with
// bounds around a point (src/trace/relief_lanes-inl.h).
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "noise/fbm.h"
#include "noise/relief/certificate.h"
#include "noise/relief/nodes/all.h"

namespace strata::noise {

// A term as a scene says it. `of` names terms before it.
struct ReliefTerm {
    std::string name;
    std::vector<std::string> of{};
    ReliefNode node{};
};

// A turn of the plan about y: x' = cosine x + sine z, z' = cosine z - sine x.
struct PlanTurn {
    double cosine, sine;
};

// A term made ready: its inputs by their place in the list.
struct ReliefPart {
    ReliefNode node;
    std::vector<std::size_t> inputs;
    std::vector<Octave> octaves;
    std::vector<double> amplitude_from;  // the sum of the amplitudes of octave k and all after it
    std::vector<PlanTurn> turns{};       // of octave k's lattice against the plan; empty: none is turned
};

struct ReliefJet {
    double value = 0.0;
    glm::dvec3 gradient{0.0};
};

class Relief {
  public:
    // dimensions: 2 (the plane's x and z) or 3. The terms' inputs are names of terms before them, in the numbers that
    // their nodes take, and no point may take more than 100,000 readings of terms; throws std::invalid_argument
    // otherwise.
    Relief(std::span<const ReliefTerm> terms, int dimensions);

    int dimensions() const { return dimensions_; }
    const std::vector<ReliefPart>& parts() const { return parts_; }

    // The reference path: by the definition, in double.
    ReliefJet jet(const glm::dvec3& x) const;

    // Of the whole relief, and of each part alone.
    const Certificate& certificate() const { return certificates_.back(); }
    const std::vector<Certificate>& certificates() const { return certificates_; }

    // Noise evaluations at a point where nothing is left out.
    std::size_t evaluations() const { return evaluations_; }

    // The highest frequency of its octaves, in lattice cells a unit, and of what repeats.
    double finest_frequency() const;

    // The lowest one; 1 where there are no octaves.
    double coarsest_frequency() const;

  private:
    int dimensions_;
    std::vector<ReliefPart> parts_;
    std::vector<Certificate> certificates_;
    std::size_t evaluations_ = 0;
};

// Of parts up to and with `last`; those it takes from are in front of it.
Certificate certificate_of(std::span<const ReliefPart> parts, std::size_t last, int dimensions);

}  // namespace strata::noise
