#include "tools/cli/installer.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <vector>

extern char** environ;

namespace strata::tools::cli {

namespace {

// As the kernel keeps them: each ends with a null.
std::vector<std::string> own_words() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
    return words;
}

}  // namespace

bool install_packages(const std::string& section) {
    const char* const installer = std::getenv("STRATA_INSTALLER");
    if (installer == nullptr) return false;
    std::string program = installer, wanted = section;
    const std::array<char*, 3> words{program.data(), wanted.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // Standard output is for what the command was asked for.
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    pid_t child = 0;
    const int error = ::posix_spawn(&child, installer, &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) return false;
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void restart_rebuilt() {
    const char* const launcher = std::getenv("STRATA_LAUNCHER");
    if (launcher == nullptr || std::getenv("STRATA_REBUILD") != nullptr) return;
    ::setenv("STRATA_REBUILD", "1", 1);
    std::vector<std::string> words = own_words();
    if (words.empty()) return;
    words.front() = launcher;
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execv(launcher, pointers.data());
}

}  // namespace strata::tools::cli
