// Every kind of relief node. A new one is a file like its neighbours here, its #include and its name in the list.
#ifndef STRATA_NOISE_RELIEF_ALL_H_
#define STRATA_NOISE_RELIEF_ALL_H_

#include <variant>

#endif

#include "noise/relief/nodes/envelope.h"
#include "noise/relief/nodes/fbm.h"
#include "noise/relief/nodes/fill.h"
#include "noise/relief/nodes/gullies.h"
#include "noise/relief/nodes/ridged.h"
#include "noise/relief/nodes/sum.h"
#include "noise/relief/nodes/warp.h"

#ifndef STRATA_NOISE_RELIEF_NODE_
#define STRATA_NOISE_RELIEF_NODE_
namespace strata::noise {

using ReliefNode = std::variant<Fbm, Ridged, Warp, Sum, Gullies, Envelope, Fill>;

}  // namespace strata::noise
#endif
