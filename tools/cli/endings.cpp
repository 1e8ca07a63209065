#include "tools/cli/endings.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <string_view>
#include <system_error>

#include "src/image/scratch_files.h"
#include "src/parallel/cancel.h"
#include "tools/cli/errors.h"
#include "tools/cli/process.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::cli {

namespace {

void on_signal(int signal, bool is_last) {
    end_programs(is_last ? SIGKILL : signal);
    if (is_last) image::remove_scratch_files();
}

// Where no handler can be: an error in a thread of a library, or before main().
[[noreturn]] void end_with_a_sentence() {
    end_programs(SIGKILL);
    image::remove_scratch_files();
    try {
        if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
        print_error("ended by an error inside a library");
    } catch (const std::exception& error) {
        print_error(message_of(error));
    } catch (...) {
        print_error("ended by an error of unknown kind");
    }
    ::_exit(kExitRuntime);
}

// Libraries of OpenImageIO's start threads before main(), and throw where there are none. So the handler is there
// before they begin: by an entry of .preinit_array, which the loader calls ahead of all libraries' constructors.
#ifdef __SANITIZE_ADDRESS__
__attribute__((no_sanitize_address))
#endif
void prepare_before_libraries() {
    std::set_terminate(end_with_a_sentence);
}

__attribute__((section(".preinit_array"), used)) void (*const before_libraries)() = prepare_before_libraries;

}  // namespace

void prepare_endings() { parallel::call_on_signals(on_signal); }

std::string message_of(const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) {
        return fmt::format(
            "no thread could be started: {}; allowed: fewer processes at a time, or a higher limit of them (ulimit -u, "
            "the container's pids limit)",
            system->code().message());
    }
    return error.what();
}

}  // namespace strata::tools::cli
