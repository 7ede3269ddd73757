// What the operating system may do to a running command: closed streams, Ctrl-C, a closed terminal.
#pragma once

namespace hamilcar::cli {

// What a file that is opened later must not become: a closed standard stream. False where standard output was closed.
bool take_standard_streams();

// From here on Ctrl-C, SIGTERM and a closed terminal end the program at once with ExitCode::interrupted, and a file that
// grows beyond its limit fails like a full disk.
void end_on_interrupt();

// While one lives they only set a flag instead: for a command that looks at `interrupted` several times a second, and
// keeps what it has so far. They may be nested. A second one ends the program all the same.
class InterruptWatch {
public:
    InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;
    ~InterruptWatch();
};
bool interrupted();

}  // namespace hamilcar::cli
