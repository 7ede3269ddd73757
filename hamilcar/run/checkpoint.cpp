#include "hamilcar/run/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "hamilcar/block/ring.hpp"
#include "hamilcar/io/error.hpp"

namespace hamilcar {

namespace {

constexpr std::array<char, 16> heading{'h', 'a', 'm', 'i', 'l', 'c', 'a', 'r', ' ', 's', 't', 'a', 't', 'e', ' ', '1'};

class Writer {
public:
    explicit Writer(const std::string& path) : file_(path, std::ios::binary), path_(path) {}
    template <class T>
    void add(const T& number) {
        static_assert(std::is_trivially_copyable_v<T>);
        file_.write(reinterpret_cast<const char*>(&number), sizeof number);
    }
    void add(const double* numbers, std::size_t count) {
        file_.write(reinterpret_cast<const char*>(numbers), static_cast<std::streamsize>(count * sizeof(double)));
    }
    void add(const std::vector<double>& numbers) {
        add(numbers.size());
        add(numbers.data(), numbers.size());
    }
    void close() {
        file_.close();
        if (!file_) {
            throw io::Error(io::ExitCode::input_output,
                            fmt::format("{}: cannot write the checkpoint: {}", path_, std::strerror(errno)));
        }
    }

private:
    std::ofstream file_;
    std::string path_;
};

class Reader {
public:
    explicit Reader(const std::string& path) : file_(path, std::ios::binary), path_(path) {
        if (file_) return;
        throw io::Error(io::ExitCode::input_output, fmt::format("{}: cannot read: {}", path, std::strerror(errno)));
    }
    template <class T>
    void take(T& number) {
        static_assert(std::is_trivially_copyable_v<T>);
        read(reinterpret_cast<char*>(&number), sizeof number);
    }
    void take(double* numbers, std::size_t count) { read(reinterpret_cast<char*>(numbers), count * sizeof(double)); }
    void take(std::vector<double>& numbers) {
        std::size_t count = 0;
        take(count);
        constexpr std::size_t most = 1u << 28;
        if (count > most) refuse();
        numbers.resize(count);
        take(numbers.data(), count);
    }
    [[noreturn]] void refuse() const {
        throw io::Error(io::ExitCode::bad_file,
                        path_ + ": expected a whole checkpoint that 'hamilcar run --checkpoint' of this version wrote");
    }

private:
    void read(char* to, std::size_t bytes) {
        if (!file_.read(to, static_cast<std::streamsize>(bytes))) refuse();
    }
    std::ifstream file_;
    std::string path_;
};

int remembered_steps(const Simulation& simulation) {
    return std::min(find_method(simulation.scenario().solver.integrator)->order, max_adams_order);
}

// Rates of every number now. The same for the same vehicle, road and inputs; all parameters that matter are in them.
State<double> rates_of(const Simulation& simulation) {
    State<double> rate;
    evaluate(simulation.model(), simulation.schedule()(simulation.time()), simulation.state(), rate);
    return rate;
}

// Calls f with every number of a snapshot that a run goes on with.
template <class Access, class Snapshotted>
void visit_numbers(Snapshotted& snapshot, std::size_t size, int order, Access&& access) {
    access(snapshot.step_count);
    access(snapshot.state.values.data(), size);
    access(snapshot.memory.remembered), access(snapshot.memory.newest), access(snapshot.memory.substep);
    access(snapshot.memory.converged);
    for (int i = 0; i < order; ++i) access(snapshot.memory.past[static_cast<std::size_t>(i)].values.data(), size);
    access(snapshot.inputs), access(snapshot.driver);
}

}  // namespace

void write_checkpoint(const std::string& path, const Simulation& simulation, const Progressed& progressed) {
    const auto snapshot = std::make_unique<Snapshot>();
    simulation.save(*snapshot);
    const std::string beside = path + ".part";
    Writer file(beside);
    const auto size = static_cast<std::size_t>(simulation.model().vehicle.state_size);
    const int order = remembered_steps(simulation);
    file.add(heading);
    file.add(size), file.add(order), file.add(simulation.scenario().solver.step);
    visit_numbers(*snapshot, size, order, [&](const auto&... what) { file.add(what...); });
    file.add(rates_of(simulation).values.data(), size);
    const RunSummary& s = progressed.summary;
    file.add(std::array<double, 4>{s.worst_opening, s.worst_energy_drift, s.largest_kinetic_energy, s.wall_time});
    file.add(progressed.x), file.add(progressed.y);
    file.close();
    std::error_code error;
    std::filesystem::rename(beside, path, error);
    if (error) {
        throw io::Error(io::ExitCode::input_output,
                        fmt::format("{}: cannot write the checkpoint: {}", path, error.message()));
    }
}

Progressed read_checkpoint(const std::string& path, Simulation& simulation) {
    Reader file(path);
    std::array<char, 16> begins{};
    file.take(begins);
    if (begins != heading) file.refuse();
    const auto size = static_cast<std::size_t>(simulation.model().vehicle.state_size);
    const int order = remembered_steps(simulation);
    std::size_t its_size = 0;
    int its_order = 0;
    double its_step = 0;
    file.take(its_size), file.take(its_order), file.take(its_step);
    const auto refuse_other = [&] [[noreturn]] {
        throw io::Error(io::ExitCode::bad_file,
                        path + ": the checkpoint is of another vehicle, scenario, method or step");
    };
    if (its_size != size || its_order != order || its_step != simulation.scenario().solver.step) refuse_other();
    const auto snapshot = std::make_unique<Snapshot>();
    visit_numbers(*snapshot, size, order, [&](auto&&... what) { file.take(what...); });
    State<double> rates;
    file.take(rates.values.data(), size);
    Progressed out;
    std::array<double, 4> figures{};
    file.take(figures);
    out.summary.worst_opening = figures[0], out.summary.worst_energy_drift = figures[1];
    out.summary.largest_kinetic_energy = figures[2], out.summary.wall_time = figures[3];
    file.take(out.x), file.take(out.y);
    simulation.restore(*snapshot);
    const State<double> here = rates_of(simulation);
    if (!std::equal(here.values.begin(), here.values.begin() + static_cast<std::ptrdiff_t>(size),
                    rates.values.begin())) {
        refuse_other();
    }
    return out;
}

}  // namespace hamilcar
