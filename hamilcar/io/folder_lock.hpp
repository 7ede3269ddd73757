// One writer a folder: two runs that write the same results.nc leave a mixture that cannot be told from a run.
#pragma once

#include <string>

namespace hamilcar::io {

// Holds the folder until it is destroyed or the process ends, however it ends; nothing is left behind. A file system
// that has no locks gives none.
class FolderLock {
public:
    // Throws Error(input_output) where another process holds it, or where it cannot be opened.
    explicit FolderLock(const std::string& folder);
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    ~FolderLock();

private:
    int folder_ = -1;
};

}  // namespace hamilcar::io
