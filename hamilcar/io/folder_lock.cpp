#include "hamilcar/io/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hamilcar/io/error.hpp"

namespace hamilcar::io {

FolderLock::FolderLock(const std::string& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (folder_ < 0) {
        throw Error(ExitCode::input_output, folder + ": cannot open the output folder: " + std::strerror(errno));
    }
    if (::flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    ::close(folder_);
    throw Error(ExitCode::input_output,
                folder +
                    ": another run is writing into this folder; expected a folder of its own for each "
                    "(--output), or wait for its end");
}

FolderLock::~FolderLock() {
    if (folder_ >= 0) ::close(folder_);
}

}  // namespace hamilcar::io
