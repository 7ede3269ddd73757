// Every file of the corpora, the seeds and what fuzzing once found, goes the way that the fuzzer's own inputs go.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "fuzz/readers.hpp"
#include "support/paths.hpp"

namespace hamilcar::fuzz {

static void PrintTo(const Reader& reader, std::ostream* out) {
    *out << reader.name;
}

namespace {

const std::filesystem::path corpora = test::source_path("tests/fuzz/corpus");

class Corpus : public testing::TestWithParam<Reader> {};

TEST_P(Corpus, ComesThrough) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpora / GetParam().name)) {
        std::ostringstream bytes;
        bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        EXPECT_NO_THROW(GetParam().run(bytes.str())) << entry.path();
        ++files;
    }
    EXPECT_GT(files, 10);
}

INSTANTIATE_TEST_SUITE_P(Readers, Corpus, testing::ValuesIn(readers().begin(), readers().end()),
                         [](const auto& reader) { return std::string(reader.param.name); });

TEST(Corpora, HaveAReaderEach) {
    std::size_t folders = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(corpora)) ++folders;
    EXPECT_EQ(folders, readers().size());
}

}  // namespace
}  // namespace hamilcar::fuzz
