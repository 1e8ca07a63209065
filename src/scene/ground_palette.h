// Grounds by name, with what they reflect. Linear Rec. 709.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string_view>

namespace strata::scene {

enum class GroundKind {
    own,
    fresh_snow,
    old_snow,
    ice,
    granite,
    limestone,
    basalt,
    red_sandstone,
    ochre_sandstone,
    pale_sandstone,
    desert_varnish,
    scree,
    dry_sand,
    desert_sand,
    wet_sand,
    dry_soil,
    wet_soil,
    red_soil,
    dry_grass,
    grass,
    conifers,
    regolith,
    mare
};

// What measured albedos say is their size: fresh snow 0.85 to 0.95 in visible light, old snow 0.5 to 0.7 (Warren,
// Optical properties of snow, Rev. Geophys. 20, 1982); rocks and soils 0.05 to 0.45 and leaves below 0.1 in the
// visible, where solar albedos, which tables give, count the infrared that leaves reflect (ASTER spectral library,
// Baldridge et al. 2009); dry sand by physicallybased.info; lunar highlands and maria 0.11 to 0.15 and 0.06 to 0.08
// (Velikodsky et al., Icarus 214, 2011). Hues were chosen by eye within these.
struct PaletteGround {
    GroundKind kind;
    std::string_view name;
    glm::dvec3 albedo;
};

inline constexpr std::size_t kGroundKinds = static_cast<std::size_t>(GroundKind::mare) + 1;

// In the order of the enumerators; the first stands for a colour of the scene's own.
inline const std::array<PaletteGround, kGroundKinds>& ground_palette() {
    static const std::array<PaletteGround, kGroundKinds> kPalette{{
        {GroundKind::own, "own", {0.0, 0.0, 0.0}},
        {GroundKind::fresh_snow, "fresh_snow", {0.90, 0.92, 0.95}},
        {GroundKind::old_snow, "old_snow", {0.60, 0.63, 0.67}},
        {GroundKind::ice, "ice", {0.35, 0.45, 0.52}},
        {GroundKind::granite, "granite", {0.30, 0.28, 0.26}},
        {GroundKind::limestone, "limestone", {0.45, 0.42, 0.37}},
        {GroundKind::basalt, "basalt", {0.05, 0.05, 0.05}},
        {GroundKind::red_sandstone, "red_sandstone", {0.38, 0.16, 0.08}},
        {GroundKind::ochre_sandstone, "ochre_sandstone", {0.46, 0.22, 0.10}},
        {GroundKind::pale_sandstone, "pale_sandstone", {0.56, 0.40, 0.26}},
        {GroundKind::desert_varnish, "desert_varnish", {0.10, 0.05, 0.04}},
        {GroundKind::scree, "scree", {0.25, 0.23, 0.20}},
        {GroundKind::dry_sand, "dry_sand", {0.44, 0.386, 0.231}},
        {GroundKind::desert_sand, "desert_sand", {0.50, 0.30, 0.155}},
        {GroundKind::wet_sand, "wet_sand", {0.20, 0.16, 0.10}},
        {GroundKind::dry_soil, "dry_soil", {0.20, 0.15, 0.10}},
        {GroundKind::wet_soil, "wet_soil", {0.06, 0.045, 0.03}},
        {GroundKind::red_soil, "red_soil", {0.36, 0.19, 0.10}},
        {GroundKind::dry_grass, "dry_grass", {0.25, 0.19, 0.08}},
        {GroundKind::grass, "grass", {0.06, 0.10, 0.03}},
        {GroundKind::conifers, "conifers", {0.02, 0.035, 0.015}},
        {GroundKind::regolith, "regolith", {0.12, 0.11, 0.10}},
        {GroundKind::mare, "mare", {0.07, 0.066, 0.06}},
    }};
    return kPalette;
}

}  // namespace strata::scene
