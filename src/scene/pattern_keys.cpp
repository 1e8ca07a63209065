#include "src/scene/pattern_keys.h"

#include "src/scene/key_makers.h"

namespace strata::scene {

namespace key_makers {
namespace {

Section zoneplate_section(Zoneplate& zoneplate, bool matters) {
    return section(
        "zoneplate", "rings that grow finer outwards", matters,
        {number("rings", zoneplate.rings, {0.0, 1e9}, "periods",
                "rings from the centre to the frame's nearer edge; 0: so many that the last is 2 pixels wide")});
}

Section checker_section(Checker& checker, bool matters) {
    return section(
        "checker", "a checkered plane that recedes to the horizon", matters,
        {number("square", checker.square, kLength, "world units", "side of a square"),
         number("height", checker.height, kLength, "world units", "height of the eye over the plane"),
         number("horizon", checker.horizon, kFraction, "of the frame's height", "where the horizon is, from the top")});
}

Section wheel_section(Wheel& wheel, bool matters) {
    return section(
        "wheel", "a spoked wheel that turns", matters,
        {count("spokes", wheel.spokes, {1, 1000}, "", "number of spokes, evenly spread"),
         number("turns_per_s", wheel.turns_per_s, {-1e6, 1e6}, "turns/s", "speed, counter-clockwise on the screen"),
         number("spoke_fill", wheel.spoke_fill, kFraction, "of the angle", "how much of the wheel is spoke")});
}

Section edge_section(Edge& edge, bool matters) {
    return section(
        "edge", "a straight edge between black and white", matters,
        {number("angle_deg", edge.angle_deg, kAngle, "degrees counter-clockwise from right",
                "direction in which the white side lies"),
         number("offset", edge.offset, kAnywhere, "pixels", "of the edge from the frame's centre in that direction")});
}

Section ramp_section(Ramp& ramp, bool matters) {
    return section(
        "ramp", "grey that rises evenly", matters,
        {number("angle_deg", ramp.angle_deg, kAngle, "degrees counter-clockwise from right", "direction of the rise"),
         number("rise", ramp.rise, {-1e6, 1e6}, "over the frame's width",
                "how much brighter; the frame's centre is 0.5")});
}

Section constant_section(Constant& constant, bool matters) {
    return section("constant", "one grey everywhere", matters,
                   {number("value", constant.value, kLight, "linear radiance", "the grey")});
}

}  // namespace
}  // namespace key_makers

void add_pattern_sections(Scene& scene, std::vector<Section>& sections) {
    using namespace key_makers;
    sections.push_back(zoneplate_section(scene.zoneplate, scene.image == ImageKind::zoneplate));
    sections.push_back(checker_section(scene.checker, scene.image == ImageKind::checker));
    sections.push_back(wheel_section(scene.wheel, scene.image == ImageKind::wheel));
    sections.push_back(edge_section(scene.edge, scene.image == ImageKind::edge));
    sections.push_back(ramp_section(scene.ramp, scene.image == ImageKind::ramp));
    sections.push_back(constant_section(scene.constant, scene.image == ImageKind::constant));
}

}  // namespace strata::scene
