// The program, run in a folder that goes away.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "support/car.hpp"

namespace hamilcar {

inline std::string contents(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

class Program : public testing::Test {
protected:
    Program() : folder_(std::filesystem::temp_directory_path() / ("hamilcar_cli_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~Program() override { std::filesystem::remove_all(folder_); }

    struct Outcome {
        int code;
        std::string out, err;
    };
    // Runs `hamilcar` with the given words, in the test's folder.
    Outcome run(const std::string& words) const {
        const std::string command =
            "cd '" + folder_.string() + "' && '" + test::program_path() + "' " + words + " >out.txt 2>err.txt";
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), contents(folder_ / "out.txt"), contents(folder_ / "err.txt")};
    }
    // A copy of a shipped file with one replacement; returns its path.
    std::string changed(const std::string& shipped, const std::string& from, const std::string& to) const {
        std::string text = contents(test::source_path(shipped));
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        const auto reference = text.find("../vehicles/");
        if (reference != std::string::npos) text.replace(reference, 12, test::source_path("vehicles/"));
        const auto tire = text.find("\"tires/");
        if (tire != std::string::npos) text.replace(tire, 1, "\"" + test::source_path("vehicles/"));
        const std::filesystem::path path = folder_ / std::filesystem::path(shipped).filename();
        std::ofstream(path) << text;
        return path.string();
    }
    std::string scenario_for(const std::string& vehicle_path, const std::string& more = "") const {
        const std::filesystem::path path = folder_ / "scenario.toml";
        std::ofstream(path) << "name = \"t\"\nvehicle = \"" << vehicle_path << "\"\nduration_s = 1.0\n" << more;
        return path.string();
    }

    std::filesystem::path folder_;
};

}  // namespace hamilcar
