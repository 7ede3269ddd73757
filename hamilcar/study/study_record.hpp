// Results of a study on disk while it goes on, a line of JSON for each run of each point, so that a study that was stopped or
// killed goes on where it was.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "hamilcar/study/study_table.hpp"

namespace hamilcar {

class StudyRecord {
public:
    // Of `sum`, the checksum of all that the results depend on: throws io::Error(usage) where the file there is of another study,
    // io::Error(input_output) where it cannot be written. `results` gets those that are there; a line that was cut off is
    // evaluated again.
    StudyRecord(const std::string& path, std::uint64_t sum, StudyResults& results);
    // On its way to the disk when it returns; throws io::Error(input_output).
    void add(std::size_t point, std::size_t run, const RunResult& result);
    std::size_t found() const { return found_; }  // that were there

private:
    void append(const std::string& line);

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::size_t found_ = 0;
};

}  // namespace hamilcar
