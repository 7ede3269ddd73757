#include "interrupt.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

#include "hamilcar/io/error.hpp"

namespace hamilcar::cli {

namespace {
volatile std::sig_atomic_t interrupt_seen = 0, interrupt_watched = 0;
extern "C" void on_interrupt(int) {
    if (!interrupt_watched) _exit(static_cast<int>(io::ExitCode::interrupted));
    interrupt_seen = 1;
}
}  // namespace

bool take_standard_streams() {
    bool output_is_open = true;
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) != -1) continue;
        if (stream == STDOUT_FILENO) output_is_open = false;
        if (::open("/dev/null", O_RDWR) != stream) return false;  // the lowest number that is free
    }
    return output_is_open;
}

void end_on_interrupt() {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second Ctrl-C ends the program at once
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);  // the terminal is closed
    std::signal(SIGXFSZ, SIG_IGN);        // a file beyond `ulimit -f` is like a full disk: the write says so
}

InterruptWatch::InterruptWatch() {
    interrupt_watched = interrupt_watched + 1;
}

InterruptWatch::~InterruptWatch() {
    interrupt_watched = interrupt_watched - 1;
}

bool interrupted() {
    return interrupt_seen != 0;
}

}  // namespace hamilcar::cli
