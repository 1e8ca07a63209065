// Every kind of relief node. A new one is a file like its neighbours here, its #include and its name in the list.
#ifndef STRATA_NOISE_RELIEF_ALL_H_
#define STRATA_NOISE_RELIEF_ALL_H_

#include <variant>

#endif

#include "noise/relief/nodes/billow.h"
#include "noise/relief/nodes/blend.h"
#include "noise/relief/nodes/craters.h"
#include "noise/relief/nodes/curve.h"
#include "noise/relief/nodes/dunes.h"
#include "noise/relief/nodes/envelope.h"
#include "noise/relief/nodes/fbm.h"
#include "noise/relief/nodes/fill.h"
#include "noise/relief/nodes/gullies.h"
#include "noise/relief/nodes/highest.h"
#include "noise/relief/nodes/hybrid.h"
#include "noise/relief/nodes/lowest.h"
#include "noise/relief/nodes/product.h"
#include "noise/relief/nodes/ramp.h"
#include "noise/relief/nodes/ridged.h"
#include "noise/relief/nodes/sum.h"
#include "noise/relief/nodes/terraces.h"
#include "noise/relief/nodes/warp.h"

#ifndef STRATA_NOISE_RELIEF_NODE_
#define STRATA_NOISE_RELIEF_NODE_
namespace strata::noise {

using ReliefNode = std::variant<Fbm, Ridged, Warp, Sum, Gullies, Envelope, Fill, Curve, Terraces, Billow, Hybrid,
                                Product, Blend, Highest, Lowest, Ramp, Dunes, Craters>;

}  // namespace strata::noise
#endif
