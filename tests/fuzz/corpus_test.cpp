// Every file of the corpus, the seeds and what fuzzing once found, goes the way that the fuzzers' own inputs go.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "fuzz/targets.hpp"
#include "support/paths.hpp"

namespace hamilcar::fuzz {
namespace {

void run_all(const std::string& name, const std::function<void(std::string_view)>& run) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_path("tests/fuzz/corpus/" + name))) {
        std::ostringstream bytes;
        bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        EXPECT_NO_THROW(run(bytes.str())) << entry.path();
        ++files;
    }
    EXPECT_GT(files, 10);
}

TEST(Corpus, Crg) {
    run_all("crg", run_crg);
}

TEST(Corpus, Tir) {
    run_all("tir", run_tir);
}

TEST(Corpus, Grid) {
    run_all("grid", run_grid);
}

}  // namespace
}  // namespace hamilcar::fuzz
