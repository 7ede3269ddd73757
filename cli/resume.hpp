// Checkpoints of `hamilcar run`: kept up to date while a run lasts, and gone on from.
#pragma once

#include <string>

#include "hamilcar/io/result_file.hpp"
#include "hamilcar/io/toml_document.hpp"
#include "hamilcar/run/checkpoint.hpp"
#include "run_files.hpp"
#include "run_options.hpp"

namespace hamilcar::cli {

// Of what a file says, merged with its bases, and of the files that it names.
std::uint64_t sum_of(const io::Node& document);
// Checksums of what the files say, merged with their bases, and of the files that they name. Left out is what may
// change where a run goes on (its duration, what is recorded) and what a checkpoint knows itself (method, step).
Origin origin_of(io::Node scenario, const io::Node& vehicle);

// Throws io::Error(usage) where the scenario writes nothing that a run can go on from.
void check_can_resume(const RunOptions& options, const ScenarioDescription& scenario);

// The first part of a run that is gone on with: how it went, and its rows in the results that it left in the folder.
struct FirstPart {
    Progressed progressed;
    io::ResultFile rows;
    std::size_t count = 0;
};

// Empty without --resume. Throws io::Error where checkpoint, results and scenario do not fit together.
FirstPart first_part(const RunOptions& options, const std::string& folder, const ScenarioDescription& scenario,
                     const Recorded& recorded, Simulation& simulation, const Origin& origin);

// Where the vehicle has been, for the road that its picture needs.
struct PathOnGround {
    std::vector<double> x, y;
    void add(const Sample& sample) { x.push_back(sample.state.position()[0]), y.push_back(sample.state.position()[1]); }
};

// Keeps a checkpoint up to date, if one is asked for.
class CheckpointKeeper {
public:
    // Writes the first one: that it cannot be written is to be known before a long run. Throws io::Error.
    CheckpointKeeper(const RunOptions& options, const Simulation& simulation, const Progressed& so_far,
                     const Origin& origin);
    // Once the interval has passed. A run does not end for a checkpoint that could not be written; a warning says so.
    void look(const Simulation& simulation, const RunSummary& summary, const PathOnGround& path, RunFiles& files);
    // The last one, of a run whose results are written; false after a message where it could not be.
    bool finish(const Simulation& simulation, const RunSummary& summary, const PathOnGround& path) const;

private:
    // What went wrong, or nothing.
    std::string try_to_write(const Simulation& simulation, const RunSummary& summary, const PathOnGround& path) const;

    std::string path_;
    Origin origin_;
    double interval_, next_;
    bool warned_ = false;
};

}  // namespace hamilcar::cli
