#include "resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "hamilcar/io/checksum.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/shipped.hpp"
#include "hamilcar/io/whole_file.hpp"
#include "hamilcar/run/run_loop.hpp"

namespace hamilcar::cli {

namespace {

template <class T>
void add_number(io::Checksum& sum, const T& number) {
    sum.add({reinterpret_cast<const char*>(&number), sizeof number});
}

// With its length: "ab", "c" is not "a", "bc".
void add_text(io::Checksum& sum, std::string_view text) {
    add_number(sum, text.size());
    sum.add(text);
}

void add_file(io::Checksum& sum, const std::filesystem::path& path) {
    sum.add(io::read_whole_file(path.string(), io::FileLimit::road));
}

// Keys that name a file end so ("file", "crg_file"); the file's content counts, not its place.
bool names_file(const io::Node& node) {
    return node.key == "file" || node.key.ends_with("_file");
}

void add_node(io::Checksum& sum, const io::Node& node) {
    add_number(sum, node.value.index());
    if (const auto* number = std::get_if<double>(&node.value)) add_number(sum, *number);
    if (const auto* truth = std::get_if<bool>(&node.value)) add_number(sum, *truth);
    if (const auto* text = std::get_if<std::string>(&node.value)) {
        if (names_file(node)) {
            const std::filesystem::path path = std::filesystem::path(node.file->path).parent_path() / *text;
            add_file(sum, io::find_tire(path, *text).value_or(path));
        } else {
            add_text(sum, *text);
        }
    }
    if (const auto* list = std::get_if<io::ListValue>(&node.value)) {
        add_number(sum, list->items.size());
        for (const io::Node& item : list->items) add_node(sum, item);
    }
    if (const auto* table = std::get_if<io::TableValue>(&node.value)) {
        std::vector<const io::Node*> entries;
        for (const io::Node& entry : table->entries) entries.push_back(&entry);
        std::ranges::sort(entries, {}, &io::Node::key);
        add_number(sum, entries.size());
        for (const io::Node* entry : entries) add_text(sum, entry->key), add_node(sum, *entry);
    }
}

void leave_out(io::Node* table, std::initializer_list<std::string_view> keys) {
    auto* entries = table ? std::get_if<io::TableValue>(&table->value) : nullptr;
    if (!entries) return;
    std::erase_if(entries->entries, [&](const io::Node& entry) { return std::ranges::count(keys, entry.key) > 0; });
}

// Why the results in the folder are not those that the checkpoint was written with; empty if they are.
std::string mismatch(const FirstPart& part, const Recorded& recorded, long every, double step) {
    const std::vector<io::Column>& columns = part.rows.columns;
    for (std::size_t i = 0; i < recorded.channels.size(); ++i) {
        const std::string& expected = recorded.channels[i].column.name;
        if (i + 1 >= columns.size()) return fmt::format("has no channel '{}', which this run records", expected);
        if (columns[i + 1].name == expected) continue;
        return fmt::format("has the channel '{}' where this run records '{}'", columns[i + 1].name, expected);
    }
    if (columns.size() > recorded.channels.size() + 1) {
        return fmt::format("has the channel '{}', which this run does not record",
                           columns[recorded.channels.size() + 1].name);
    }
    const std::vector<double>& time = part.rows.values[0];
    if (time.size() < part.count) return "ends before the checkpoint";
    for (std::size_t i = 0; i < part.count; ++i) {
        const double expected = static_cast<double>(static_cast<long>(i) * every) * step;
        if (time[i] == expected) continue;
        return fmt::format("has a row at t = {:g} s where this run has one at t = {:g} s", time[i], expected);
    }
    return {};
}

}  // namespace

std::uint64_t sum_of(const io::Node& document) {
    io::Checksum sum;
    add_node(sum, document);
    return sum.value();
}

Origin origin_of(io::Node scenario, const io::Node& vehicle) {
    leave_out(&scenario, {"duration_s", "vehicle", "output"});
    leave_out(scenario.find("solver"), {"step_s", "integrator"});
    return {.vehicle = sum_of(vehicle), .scenario = sum_of(scenario)};
}

void check_can_resume(const RunOptions& options, const ScenarioDescription& scenario) {
    if (scenario.output.netcdf || (options.checkpoint.empty() && options.resume.empty())) return;
    throw io::Error(io::ExitCode::usage, fmt::format("{}resuming requires netCDF output; {} expects "
                                                     "'output.netcdf = true'",
                                                     at_key(scenario.places, "output.netcdf"),
                                                     options.resume.empty() ? "--checkpoint" : "--resume"));
}

FirstPart first_part(const RunOptions& options, const std::string& folder, const ScenarioDescription& scenario,
                     const Recorded& recorded, Simulation& simulation, const Origin& origin) {
    FirstPart part;
    if (options.resume.empty()) return part;
    part.progressed = read_checkpoint(options.resume, simulation, origin);
    if (simulation.steps_taken() > simulation.total_steps()) {
        throw io::Error(io::ExitCode::bad_file,
                        fmt::format("{}: the checkpoint is of t = {:g} s, after the end of {} at {:g} s",
                                    options.resume, simulation.time(), options.scenario, scenario.duration));
    }
    const long every = steps_per_row(simulation, scenario.output.interval);
    part.count = static_cast<std::size_t>((simulation.steps_taken() + every - 1) / every);
    if (part.count == 0) return part;  // of the very beginning
    const std::string results = folder + "/results.nc";
    const bool there = std::filesystem::exists(results);
    if (there) part.rows = io::read_result(results);
    const std::string why = there ? mismatch(part, recorded, every, scenario.solver.step) : std::string("is not there");
    if (why.empty()) return part;
    throw io::Error(io::ExitCode::bad_file,
                    fmt::format("{}: {}; --resume goes on with the results of the run that wrote the checkpoint, "
                                "expected them in the folder of --output",
                                results, why));
}

CheckpointKeeper::CheckpointKeeper(const RunOptions& options, const Simulation& simulation, const Progressed& so_far,
                                   const Origin& origin)
    : path_(options.checkpoint),
      origin_(origin),
      interval_(options.checkpoint_interval.value_or(0)),
      next_(simulation.time() + interval_) {
    if (!path_.empty()) write_checkpoint(path_, simulation, so_far, origin_);
}

void CheckpointKeeper::look(const Simulation& simulation, const RunSummary& summary, const PathOnGround& path,
                            RunFiles& files) {
    if (path_.empty() || interval_ <= 0 || simulation.time() < next_) return;
    next_ += interval_;
    files.flush();  // first: a checkpoint is of no use if the results end before it
    const std::string trouble = try_to_write(simulation, summary, path);
    if (trouble.empty() || std::exchange(warned_, true)) return;
    fmt::print(stderr, "hamilcar: warning: {}; the run goes on, the last checkpoint stays\n", trouble);
}

bool CheckpointKeeper::finish(const Simulation& simulation, const RunSummary& summary, const PathOnGround& path) const {
    if (summary.ended_early) return true;  // no run continues where the mathematics gave up: the last checkpoint stays
    const std::string trouble = path_.empty() ? "" : try_to_write(simulation, summary, path);
    if (!trouble.empty()) fmt::print(stderr, "hamilcar: {}\n", trouble);
    return trouble.empty();
}

std::string CheckpointKeeper::try_to_write(const Simulation& simulation, const RunSummary& summary,
                                           const PathOnGround& path) const {
    try {
        write_checkpoint(path_, simulation, {summary, path.x, path.y}, origin_);
        return {};
    } catch (const io::Error& error) {
        return error.what();
    }
}

}  // namespace hamilcar::cli
