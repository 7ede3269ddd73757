// Checkpoints of a driven car in a folder that goes away.
#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "hamilcar/io/error.hpp"
#include "hamilcar/run/checkpoint.hpp"
#include "support/driven.hpp"

namespace hamilcar {

class Checkpoint : public testing::Test {
protected:
    Checkpoint()
        : folder_(std::filesystem::temp_directory_path() / ("hamilcar_checkpoint_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~Checkpoint() override { std::filesystem::remove_all(folder_); }
    std::string path(const char* name = "state") const { return (folder_ / name).string(); }
    // No half of a file beside it.
    bool is_alone() const {
        return std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()) == 1;
    }

private:
    std::filesystem::path folder_;
};

inline void expect_same(const Simulation& a, const Simulation& b) {
    ASSERT_EQ(a.steps_taken(), b.steps_taken());
    for (int i = 0; i < a.model().vehicle.state_size; ++i) {
        const auto k = static_cast<std::size_t>(i);
        ASSERT_EQ(a.state().values[k], b.state().values[k]) << i;
    }
}

inline std::string message_of(const std::string& path, Simulation& car, const Origin& origin = {}) {
    try {
        read_checkpoint(path, car, origin);
    } catch (const io::Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace hamilcar
