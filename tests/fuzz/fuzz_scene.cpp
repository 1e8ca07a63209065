// Any text is a scene that prints as it reads, or is refused with a SceneError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/scene_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        strata::fuzz::check_scene(strata::scene::read_scene({reinterpret_cast<const char*>(data), size}, "fuzzed"),
                                  size);
    } catch (const strata::scene::SceneError&) {
    }
    return 0;
}
