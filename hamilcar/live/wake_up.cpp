#include "hamilcar/live/wake_up.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "hamilcar/io/error.hpp"

namespace hamilcar::live {

WakeUp::WakeUp() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (descriptor_ >= 0) return;
    throw io::Error(io::ExitCode::input_output, std::string("cannot open an eventfd: ") + std::strerror(errno));
}

WakeUp::~WakeUp() {
    close(descriptor_);
}

void WakeUp::signal() const {
    eventfd_write(descriptor_, 1);  // fails after 2^64 - 1 pending signals, when one is pending anyway
}

void WakeUp::clear() const {
    eventfd_t signals = 0;
    eventfd_read(descriptor_, &signals);  // fails if none is pending
}

}  // namespace hamilcar::live
