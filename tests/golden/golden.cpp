// golden check TARGET PINS LEFT    holds all scenes against the pins of one SIMD target
// golden pin PINS LEFT             pins them anew on every target of this machine
//
// PINS is the folder of the pins; pictures of what differs are left in LEFT. Exits with 0 when all is as pinned or was
// pinned, 1 when something differs, 77 when the machine cannot tell, 2 for a wrong command line.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "noise/simd_target.h"
#include "tests/golden/check.h"
#include "tests/golden/reference_picture.h"

using namespace strata;

namespace {

constexpr int kFailed = 1, kWrongCommandLine = 2, kNoVerdict = 77;
constexpr const char* kTargets[] = {"avx512", "avx2", "sse4", "scalar"};

int check_target(const std::string& target, const golden::Folders& folders) {
    if (!noise::pin_simd_target(target)) {
        fmt::print("No verdict: this machine or program has no {}.\n", target);
        return kNoVerdict;
    }
    switch (golden::check(target, golden::golden_scenes(), folders)) {
        case golden::Verdict::same:
            return 0;
        case golden::Verdict::differs:
            return kFailed;
        case golden::Verdict::differs_elsewhere:
            return kNoVerdict;
    }
    return kFailed;
}

// The reference target comes last: until then its pictures are those before.
int pin_targets(const golden::Folders& folders) {
    std::vector<std::string> left_alone;
    for (const std::string target : kTargets) {
        if (noise::pin_simd_target(target)) {
            golden::pin(target, golden::golden_scenes(), folders);
        } else {
            left_alone.push_back(target);
        }
    }
    for (const std::string& target : left_alone) {
        fmt::print("{}: not on this machine; its pins stay as they are and are wrong if others changed\n", target);
    }
    return 0;
}

int run(const std::vector<std::string>& words) {
    if (words.size() == 4 && words[0] == "check" && std::ranges::count(kTargets, words[1]) == 1) {
        return check_target(words[1], {words[2], words[3]});
    }
    if (words.size() == 3 && words[0] == "pin") return pin_targets({words[1], words[2]});
    fmt::print(stderr, "golden: check avx512|avx2|sse4|scalar PINS LEFT, or pin PINS LEFT\n");
    return kWrongCommandLine;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        fmt::print(stderr, "golden: {}\n", error.what());
        return kFailed;
    }
}
