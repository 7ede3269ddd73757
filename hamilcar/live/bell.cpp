#include "hamilcar/live/bell.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "hamilcar/io/error.hpp"

namespace hamilcar::live {

Bell::Bell() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (descriptor_ >= 0) return;
    throw io::Error(io::ExitCode::input_output, std::string("cannot open an eventfd: ") + std::strerror(errno));
}

Bell::~Bell() {
    close(descriptor_);
}

void Bell::ring() const {
    eventfd_write(descriptor_, 1);  // fails where it has rung 2^64 times unheard, which is loud enough
}

void Bell::silence() const {
    eventfd_t rings = 0;
    eventfd_read(descriptor_, &rings);  // fails where it has not rung
}

}  // namespace hamilcar::live
