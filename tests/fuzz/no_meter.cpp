// In place of the light meter, which renders: the fuzzers read, and do without the engine, which would take as long
// again to build. A scene whose exposure is to be metered keeps the one that it states.
#include "src/render/meter.h"

namespace strata::render {

void take_exposure(scene::Scene& scene) { scene.film.metered = false; }

}  // namespace strata::render
