// Other renderers at the scene hyperterrain, measured in turns with our own cases.
//
//   POV-Ray 3.7   its isosurface, max_gradient guaranteed, or as loose as its users set it, and with shadow rays. The
//   noise
//                 is POV-Ray's own generator 3, Perlin's of 2002, scaled to [-1,1]: the same 12 edge gradients and
//                 fade, so the same bound of its slope, with other gradients at the corners: other hills of the same
//                 spectrum (rms 0.291 and 0.271, rms slope 1.229 and 1.219 an octave). One ray a pixel, on one thread.
//   Embree 3      our own surface's first hit from straight above on 2048x2048 vertices, as a triangle mesh, and the
//                 very rays of our estimator at N = 4. Only the intersection is timed: no ray is made, nothing shaded.
#pragma once

#include <filesystem>
#include <vector>

#include "src/parallel/cancel.h"
#include "tools/bench/results.h"
#include "tools/cli/temporary_folder.h"

namespace strata::tools::bench {

class Peers {
  public:
    // Looks for the programs; those that are not there are left out, and told by report(). Writes their scenes.
    explicit Peers(const Plan& plan);

    // Every peer once; false if cancelled. Throws ProcessError when one fails.
    bool measure_round(const parallel::CancelToken& cancel);

    // Adds the peers and those that are missing. Only rounds that results counts are taken.
    void report(Results& results) const;

  private:
    struct Povray {
        const char* id;
        double max_gradient;
        bool shadows;
    };

    void find_programs();
    void measure_povray(const Povray& variant);
    void measure_embree();
    PeerResult& result(const std::string& id, const std::string& what);

    Plan plan_;
    cli::TemporaryFolder scratch_{"bench"};
    std::filesystem::path povray_, embree_;  // empty: not there
    std::vector<PeerResult> results_;
    std::vector<std::string> missing_;
};

// Installs what is missing, where that can be, and starts the program anew if more of it is to be built then.
void install_peers();

// The scene for POV-Ray; max_gradient and shadows are declared on its command line.
std::string povray_scene(const scene::Scene& scene);

// CPU seconds of tracing, from POV-Ray's closing statistics. Throws ProcessError where they do not say.
double povray_trace_seconds(const std::string& output);

}  // namespace strata::tools::bench
