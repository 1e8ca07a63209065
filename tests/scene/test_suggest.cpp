#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "src/scene/enum_names.h"
#include "src/scene/suggest.h"

using namespace strata;
using namespace strata::scene;

namespace {

// The definition of the optimal string alignment distance, by plain recursion from the front.
std::size_t slow_distance(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return std::max(a.size(), b.size());
    if (a[0] == b[0]) return slow_distance(a.substr(1), b.substr(1));
    std::size_t best = 1 + std::min({slow_distance(a.substr(1), b), slow_distance(a, b.substr(1)),
                                     slow_distance(a.substr(1), b.substr(1))});
    if (a.size() > 1 && b.size() > 1 && a[0] == b[1] && a[1] == b[0]) {
        best = std::min(best, 1 + slow_distance(a.substr(2), b.substr(2)));
    }
    return best;
}

const std::vector<std::string> kEstimators(kEnumNames<EstimatorKind>.begin(), kEnumNames<EstimatorKind>.end());

}  // namespace

TEST_CASE("the edit distance is that of its recursive definition on random short words") {
    std::mt19937 random(7);
    std::size_t largest = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string a(random() % 6, 'a');
        std::string b(random() % 6, 'a');
        for (char& c : a) c = static_cast<char>('a' + random() % 3);
        for (char& c : b) c = static_cast<char>('a' + random() % 3);
        CAPTURE(a);
        CAPTURE(b);
        const std::size_t distance = edit_distance(a, b);
        CHECK(distance == slow_distance(a, b));
        largest = std::max(largest, distance);
    }
    CHECK(largest == 5);
}

TEST_CASE("one slip in a name of three letters or more is understood, whatever the slip") {
    for (const std::string& name : kEstimators) {
        for (std::size_t i = 0; i < name.size(); ++i) {
            std::string dropped = name;
            dropped.erase(i, 1);
            std::string doubled = name;
            doubled.insert(i, 1, name[i]);
            std::string swapped = name;
            if (i > 0) std::swap(swapped[i], swapped[i - 1]);
            for (const std::string& slip : {dropped, doubled, swapped}) {
                CAPTURE(slip);
                CHECK(nearest(slip, kEstimators) == name);
            }
        }
    }
}

TEST_CASE("letter case and a beginning of three letters are understood") {
    CHECK(nearest("SOBOL", kEstimators) == "sobol");
    CHECK(nearest("strat", kEstimators) == "stratified");
    CHECK(nearest("uni", kEstimators) == "uniform");
    CHECK(nearest("n", std::vector<std::string>{"m", "N"}) == "N");
}

TEST_CASE("nothing is suggested for words that resemble no name") {
    CHECK(!nearest("", kEstimators));
    CHECK(!nearest("gaussian", kEstimators));
    CHECK(!nearest("x", std::vector<std::string>{"N", "m"}));
    CHECK(!nearest("st", kEstimators));
    CHECK(!nearest(std::string(100000, 's'), kEstimators));
    CHECK(!nearest("sobol", {}));
}

TEST_CASE("a whole name nearer than a beginning wins, and the first of equals") {
    CHECK(nearest("shared", kEstimators) == "shared");
    CHECK(nearest("bat", std::vector<std::string>{"cat", "rat"}) == "cat");
}

TEST_CASE("enumerators and names convert both ways, and other names are refused") {
    for (const std::string_view name : kEnumNames<EstimatorKind>) {
        REQUIRE(from_name<EstimatorKind>(name).has_value());
        CHECK(name_of(*from_name<EstimatorKind>(name)) == name);
    }
    CHECK(name_of(EstimatorKind::none) == "none");
    CHECK(name_of(EstimatorKind::stratified) == "stratified");
    CHECK(name_of(EstimatorKind::shared_sobol) == "shared-sobol");
    CHECK(scene::name_of(solid::kKind<solid::LevelSet>) == "isosurface");
    CHECK(name_of(ImageKind::wheel) == "wheel");
    CHECK(scene::name_of(solid::LevelSet::Bound::box) == "box");
    CHECK(!from_name<EstimatorKind>("shared_sobol"));
    CHECK(!from_name<ImageKind>(""));
}
