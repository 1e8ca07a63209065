#include "src/parallel/processors.h"

#include <doctest/doctest.h>
#include <sched.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace strata::parallel;
namespace fs = std::filesystem;

namespace {

// A root folder with a /proc and a /sys of its own.
class FakeRoot {
  public:
    FakeRoot() {
        std::string name = (fs::temp_directory_path() / "strata-groups-XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    ~FakeRoot() { fs::remove_all(path_); }
    FakeRoot(const FakeRoot&) = delete;
    FakeRoot& operator=(const FakeRoot&) = delete;

    FakeRoot& with(const std::string& file, const std::string& text) {
        fs::create_directories((path_ / file).parent_path());
        std::ofstream(path_ / file) << text << '\n';
        return *this;
    }
    GroupLimits limits() const { return group_limits(path_); }

  private:
    fs::path path_;
};

}  // namespace

TEST_CASE("version 2: the least quota and memory of the group and of those around it counts") {
    FakeRoot root;
    root.with("proc/self/cgroup", "0::/pod/box").with("sys/fs/cgroup/pod/box/cpu.max", "max 100000");
    root.with("sys/fs/cgroup/pod/cpu.max", "150000 100000").with("sys/fs/cgroup/pod/box/memory.max", "536870912");
    root.with("sys/fs/cgroup/pod/memory.max", "max");
    CHECK(root.limits().processors == 1.5);
    CHECK(root.limits().memory_bytes == 536870912u);
}

TEST_CASE("version 2: in a container that sees its group as the top, the top counts") {
    FakeRoot root;
    root.with("proc/self/cgroup", "0::/").with("sys/fs/cgroup/cpu.max", "20000 100000");
    root.with("sys/fs/cgroup/memory.max", "1000000");
    CHECK(root.limits().processors == 0.2);
    CHECK(root.limits().memory_bytes == 1000000u);
}

TEST_CASE("version 1: quota and memory are those of the controllers' own hierarchies") {
    FakeRoot root;
    root.with("proc/self/cgroup", "4:memory:/docker/9f\n3:cpu,cpuacct:/docker/9f\n0::/");
    root.with("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "300000");
    root.with("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000");
    root.with("sys/fs/cgroup/memory/docker/9f/memory.limit_in_bytes", "2000000000");
    root.with("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
    CHECK(root.limits().processors == 3.0);
    CHECK(root.limits().memory_bytes == 2000000000u);
}

TEST_CASE("no quota, no limit, no groups and damaged files limit nothing") {
    CHECK(!FakeRoot().limits().processors);
    FakeRoot root;
    root.with("proc/self/cgroup", "nonsense\n2:cpu:/\n1:memory:/\n0::/");
    root.with("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1").with("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000");
    root.with("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
    root.with("sys/fs/cgroup/unified/cpu.max", "").with("sys/fs/cgroup/unified/memory.max", "max");
    CHECK(!root.limits().processors);
    CHECK(!root.limits().memory_bytes);
}

TEST_CASE("a process bound to one processor takes one") {
    cpu_set_t before, one;
    REQUIRE(sched_getaffinity(0, sizeof before, &before) == 0);
    int first = 0;
    while (!CPU_ISSET(first, &before)) ++first;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
    CHECK(available_processors() == 1);
    sched_setaffinity(0, sizeof before, &before);
    CHECK(available_processors() <= CPU_COUNT(&before));
    CHECK(available_memory_bytes() > 0);
}
