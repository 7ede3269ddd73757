// Readers that take a path: what any bytes at all in a file must come through (targets.hpp).
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "fuzz/targets.hpp"
#include "hamilcar/io/checksum.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/result_file.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/maneuver/outcome_file.hpp"
#include "hamilcar/run/checkpoint.hpp"
#include "hamilcar/study/study_file.hpp"
#include "support/driven.hpp"

namespace hamilcar::fuzz {

// A file that has no name but its number, and is gone with this.
class NamelessFile {
public:
    explicit NamelessFile(std::string_view bytes) : number_(::memfd_create("file", MFD_CLOEXEC)) {
        demand(number_ >= 0 && ::write(number_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
               "no file to write to");
    }
    NamelessFile(const NamelessFile&) = delete;
    NamelessFile& operator=(const NamelessFile&) = delete;
    ~NamelessFile() { ::close(number_); }
    std::string path() const { return "/proc/self/fd/" + std::to_string(number_); }

private:
    int number_;
};

// Reads the bytes as a file; what it names besides may be missing.
template <class Read>
void read_as_file(std::string_view bytes, Read&& read) {
    const NamelessFile file(bytes);
    try {
        read(file.path());
    } catch (const io::Error& error) {
        const bool of_a_file = error.code() == io::ExitCode::bad_file || error.code() == io::ExitCode::input_output;
        demand(of_a_file && *error.what() != '\0', "a mistake that is none of the file's");
    }
}

inline void run_vehicle(std::string_view bytes) {
    read_as_file(bytes, [](const std::string& path) {
        const VehicleDescription vehicle = io::read_vehicle(path);
        demand(vehicle.chassis.mass > 0 && !vehicle.suspensions.empty(), "a vehicle without mass or wheels");
    });
}

inline void run_scenario(std::string_view bytes) {
    read_as_file(bytes, [](const std::string& path) {
        const ScenarioDescription scenario = io::read_scenario(path);
        demand(scenario.duration > 0 && scenario.solver.step > 0, "a scenario without time");
    });
}

inline void run_study(std::string_view bytes) {
    read_as_file(bytes, [](const std::string& path) {
        const StudyDescription study = read_study(path);
        demand(!study.runs.empty() && !study.parameters.empty(), "a study of nothing");
        std::size_t values = study.points;
        for (const StudyParameter& parameter : study.parameters) values += parameter.values.size() + parameter.count;
        if (values > 20) return;  // a million points take their time
        for (const StudyPoint& point : points_of(study)) {
            demand(point.values.size() == study.parameters.size(), "a point without all its values");
        }
    });
}

// A result: its netCDF header, its columns, its scene.
inline void run_netcdf(std::string_view bytes) {
    read_as_file(bytes, [](const std::string& path) {
        const io::ResultFile result = io::read_result(path);
        demand(!result.values.empty() && result.values.size() == result.columns.size(), "columns without a name");
        for (const auto& column : result.values) {
            demand(!column.empty() && column.size() == result.values[0].size(), "columns of two lengths");
        }
    });
}

// A netCDF classic file of one row, with the text as its scene.
inline std::string result_with_scene(std::string_view scene) {
    std::string file = "CDF\x01";
    const auto word = [&](std::size_t number) {
        for (int shift = 24; shift >= 0; shift -= 8) file += static_cast<char>(number >> shift & 0xff);
    };
    const auto text = [&](std::string_view what) {
        word(what.size());
        file += what;
        while (file.size() % 4 != 0) file += '\0';
    };
    constexpr std::size_t dimensions = 10, variables = 11, attributes = 12, of_text = 2, of_doubles = 6;
    word(0), word(dimensions), word(1), text("time"), word(1);
    word(attributes), word(1), text(io::scene_attribute), word(of_text), text(scene);
    word(variables), word(1), text("time"), word(1), word(0), word(0), word(0), word(of_doubles), word(8);
    word(file.size() + 4);
    return file + std::string(8, '\0');
}

inline void run_scene(std::string_view bytes) {
    read_as_file(result_with_scene(bytes), [&](const std::string& path) {
        const io::ResultFile result = io::read_result(path);
        demand(io::json_text(io::parse_json(result.scene), -1).size() < 10 * bytes.size() + 100, "a scene that grows");
    });
}

inline void run_outcome(std::string_view bytes) {
    read_as_file(bytes, [](const std::string& path) {
        const auto [run, outcome] = read_outcome(path);
        demand(!io::json_text(outcome_json(run, outcome)).empty(), "an outcome that cannot be written");
    });
}

// A run with a driver, and its checkpoint.
struct Forgery {
    Forgery() : car(test::shipped_car(), test::driven()) {
        for (int i = 0; i < 103; ++i) demand(!car.advance(), "a run that ends");
        std::string folder = (std::filesystem::temp_directory_path() / "hamilcar_fuzz_XXXXXX").string();
        demand(::mkdtemp(folder.data()) != nullptr, "no folder to write to");
        write_checkpoint(folder + "/state", car, {{}, {1, 2}, {3, 4}});
        std::ifstream file(folder + "/state", std::ios::binary);
        bytes = {std::istreambuf_iterator<char>(file), {}};
        std::filesystem::remove_all(folder);
    }
    Simulation car;
    std::string bytes;
};

// A checkpoint that was forged, its sum made right again: each ten bytes are a place, from the end where the first bit is
// set, and what is written there. What is left over is cut off the file, so many bytes.
inline void run_checkpoint(std::string_view changes) {
    static const Forgery genuine;
    std::string bytes = genuine.bytes;
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    for (; changes.size() >= 10; changes.remove_prefix(10)) {
        std::uint16_t place = 0;
        std::memcpy(&place, changes.data(), sizeof place);
        const std::size_t last = bytes.size() - 8, distance = (place >> 1) % (last + 1);
        std::memcpy(bytes.data() + (place % 2 == 1 ? last - distance : distance), changes.data() + 2, 8);
    }
    bytes.resize(bytes.size() - changes.size());
    io::Checksum sum;
    sum.add(bytes);
    const std::uint64_t number = sum.value();
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    const auto car = std::make_unique<Simulation>(genuine.car);
    read_as_file(bytes, [&](const std::string& path) {
        read_checkpoint(path, *car);
        for (int i = 0; i < 3 && !car->finished(); ++i)
            if (car->advance()) break;
    });
}

}  // namespace hamilcar::fuzz
