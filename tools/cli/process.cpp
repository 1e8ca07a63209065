#include "tools/cli/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "tools/cli/installer.h"

extern char** environ;

namespace strata::tools::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostWords = 4000;  // of a failed program's output: its end says why

[[noreturn]] void fail(const fs::path& program, const std::string& why) {
    throw ProcessError(fmt::format("{}: {}", program.filename().string(), why));
}

// A pipe for the child's output; this end closes itself.
class OutputPipe {
  public:
    explicit OutputPipe(const fs::path& program) {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0) fail(program, std::strerror(errno));
    }
    ~OutputPipe() {
        close_writing();
        ::close(ends_[0]);
    }
    OutputPipe(const OutputPipe&) = delete;
    OutputPipe& operator=(const OutputPipe&) = delete;

    int writing_end() const { return ends_[1]; }

    void close_writing() {
        if (ends_[1] >= 0) ::close(ends_[1]);
        ends_[1] = -1;
    }

    // Until the child has closed its end: its last words.
    std::string read_all() const {
        std::string text;
        std::array<char, 4096> buffer;
        for (;;) {
            const ssize_t count = ::read(ends_[0], buffer.data(), buffer.size());
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return text;
            text.append(buffer.data(), static_cast<std::size_t>(count));
            if (text.size() > 2 * kMostWords) text.erase(0, text.size() - kMostWords);
        }
    }

  private:
    std::array<int, 2> ends_{-1, -1};
};

bool ignores_interrupts() {
    struct sigaction present = {};
    return ::sigaction(SIGINT, nullptr, &present) == 0 && present.sa_handler == SIG_IGN;
}

// The programs that are running, for handlers of signals; 0: a free place.
std::array<std::atomic<pid_t>, 16> running{};
static_assert(std::atomic<pid_t>::is_always_lock_free);

// A signal can come while a program has been started and is not yet in the list: whoever enters it there looks whether
// one came meanwhile.
std::atomic<unsigned> signals_sent{0};
std::atomic<int> latest_signal{0};

class Running {
  public:
    // `sent_before` is signals_sent as it was before the program was started.
    Running(pid_t child, unsigned sent_before) : child_(child) {
        for (auto& place : running) {
            pid_t free = 0;
            if (place.compare_exchange_strong(free, child)) break;
        }
        if (signals_sent.load() != sent_before) ::kill(child, latest_signal.load());
    }
    ~Running() {
        for (auto& place : running) {
            pid_t child = child_;
            if (place.compare_exchange_strong(child, 0)) return;
        }
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

  private:
    pid_t child_;
};

// Until it has ended, still to be reaped: its number is its own until then.
void await_end(pid_t child) {
    siginfo_t info;
    while (::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
}

pid_t start(const fs::path& program, const std::vector<std::string>& arguments, const OutputPipe& output) {
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);

    // Ignored here to become errors of writing; elsewhere they end whoever is not prepared.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    sigaddset(&defaults, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    short flags = POSIX_SPAWN_SETSIGDEF;
    // Programs that catch SIGINT though it was ignored would stop at a Ctrl-C that is not meant for this group.
    if (ignores_interrupts()) flags = static_cast<short>(flags | POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setflags(&attributes, flags);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output.writing_end(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output.writing_end(), STDERR_FILENO);
    pid_t child = 0;
    const int error = ::posix_spawn(&child, program.c_str(), &actions, &attributes, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) fail(program, std::strerror(error));
    return child;
}

int wait_for(pid_t child, rusage& usage) {
    int status = 0;
    while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    return status;
}

}  // namespace

void end_programs(int signal) noexcept {
    latest_signal.store(signal);
    signals_sent.fetch_add(1);
    for (const auto& place : running) {
        if (const pid_t child = place.load(); child > 0) ::kill(child, signal);
    }
}

fs::path search_path(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::string_view folders = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
    while (!folders.empty()) {
        const std::size_t end = std::min(folders.find(':'), folders.size());
        fs::path candidate = fs::path(folders.substr(0, end)) / name;
        if (::access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate)) return candidate;
        folders.remove_prefix(std::min(end + 1, folders.size()));
    }
    return {};
}

fs::path find_program(const std::string& name, const std::string& debian_package, const std::string& section) {
    fs::path found = search_path(name);
    if (found.empty() && install_packages(section)) found = search_path(name);
    if (!found.empty()) return found;
    throw ProcessError(fmt::format("{} is not installed: Debian has it in the package {}", name, debian_package));
}

ProgramRun run_program(const fs::path& program, const std::vector<std::string>& arguments) {
    OutputPipe output(program);
    const unsigned sent_before = signals_sent.load();
    const pid_t child = start(program, arguments, output);
    output.close_writing();
    std::string words;
    {
        const Running reached_by_signals(child, sent_before);
        words = output.read_all();
        await_end(child);
    }
    rusage usage{};
    const int status = wait_for(child, usage);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        return {std::move(words), static_cast<std::uint64_t>(usage.ru_maxrss) * 1024};
    }
    const std::string how = WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                                                : fmt::format("failed with code {}", WEXITSTATUS(status));
    fail(program, words.empty() ? how : fmt::format("{}:\n{}", how, words));
}

}  // namespace strata::tools::cli
