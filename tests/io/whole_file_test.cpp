// Files read and written whole: what has no end is refused, what is written is there or not, and links are not followed.
#include "hamilcar/io/whole_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "hamilcar/io/folder_lock.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/toml_document.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

TEST(WholeFile, IsReadUpToItsLimit) {
    const TemporaryFolder folder;
    const std::string path = folder.write("file", std::string(1000, 'x'));
    EXPECT_EQ(read_whole_file(path, 1000), std::string(1000, 'x'));
    expect_error([&] { read_whole_file(path, 999, "key 'a': "); }, ExitCode::bad_file, {"key 'a': " + path, "larger"});
    EXPECT_FALSE(read_whole_file("/proc/self/status", 100'000).empty());  // whose size is told as nothing
}

TEST(WholeFile, IsNoDevicePipeOrFolder) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    expect_error([&] { read_whole_file(folder / "pipe", 10); }, ExitCode::input_output, {"is a pipe"});
    expect_error([&] { read_whole_file("/dev/zero", 10); }, ExitCode::input_output, {"is a device"});
    expect_error([&] { read_whole_file(folder / ".", 10); }, ExitCode::input_output, {"Is a directory"});
    expect_error([&] { read_whole_file(folder / "none", 10); }, ExitCode::input_output, {"No such file"});
    const std::string file = folder.write("s.toml", "base = \"/dev/zero\"\n");
    expect_error([&] { read_toml(file); }, ExitCode::input_output, {"s.toml:1:8", "is a device"});
}

TEST(WholeFile, IsWrittenCompletelyOrNotAtAll) {
    const TemporaryFolder folder;
    const std::string path = folder.write("file", "earlier");
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{100, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    expect_error([&] { write_whole_file(path, {std::string(1000, 'x')}); }, ExitCode::input_output,
                 {"cannot write: File too large"});
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, previous);
    EXPECT_EQ(read_file(path), "earlier");
    write_whole_file(path, {"one", " and ", "two"});
    EXPECT_EQ(read_file(path), "one and two");
    const std::filesystem::directory_iterator all(folder / "");
    EXPECT_EQ(std::distance(all, std::filesystem::directory_iterator()), 1);
}

TEST(WholeFile, IsNotWrittenThroughALink) {
    const TemporaryFolder folder;
    folder.write("victim", "precious");
    std::filesystem::create_symlink("victim", folder / "link");
    expect_error([&] { write_whole_file(folder / "link", {"x"}); }, ExitCode::input_output, {"is a link"});
    expect_error([&] { create_beside(folder / "link"); }, ExitCode::input_output, {"is a link"});
    EXPECT_EQ(read_file(folder / "victim"), "precious");
}

TEST(WholeFile, HasANameBesideItThatCannotBeGuessed) {
    const TemporaryFolder folder;
    const std::string one = create_beside(folder / "file"), other = create_beside(folder / "file");
    EXPECT_NE(one, other);
    EXPECT_TRUE(std::filesystem::is_regular_file(one));
    EXPECT_FALSE(std::filesystem::exists(folder / "file.part"));
}

TEST(FolderLock, LetsOneWriterIn) {
    const TemporaryFolder folder;
    {
        const FolderLock lock(folder / "");
        expect_error([&] { FolderLock{folder / ""}; }, ExitCode::input_output, {"another run is writing"});
    }
    const FolderLock again(folder / "");
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

TEST(JsonText, StandsAnyBytesAndAnyDepth) {
    EXPECT_EQ(json_text(nlohmann::json("caf\xe9/"), -1), "\"caf\xef\xbf\xbd/\"");
    EXPECT_TRUE(parse_json(std::string(1'000'000, '[')).is_discarded());
    EXPECT_TRUE(parse_json("[1").is_discarded());
    EXPECT_EQ(parse_json(R"(["[[[[\"[", {"a": []}])").size(), 2u);
    const std::string deepest = std::string(max_json_depth, '[') + std::string(max_json_depth, ']');
    EXPECT_FALSE(parse_json(deepest).is_discarded());
    EXPECT_TRUE(parse_json("[" + deepest + "]").is_discarded());
}

TEST(FileBeginning, IsThatOfARegularFile) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.txt", "abcdef");
    EXPECT_EQ(file_beginning(path, 3), "abc");
    EXPECT_EQ(file_beginning(path, 30), "abcdef");
    EXPECT_EQ(file_beginning(folder / "none", 3), "");
    EXPECT_EQ(file_beginning("/dev/zero", 3), "");
}

TEST(PutInPlace, ReplacesWhatWasThere) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.txt", "old"), name = folder.write("b.txt", "new");
    put_in_place(name, path);
    EXPECT_EQ(read_file(path), "new");
    EXPECT_FALSE(std::filesystem::exists(name));
    expect_error([&] { put_in_place(name, path); }, ExitCode::input_output,
                 {"a.txt: cannot put the file in its place"});
    EXPECT_EQ(read_file(path), "new");
}

TEST(TomlDepth, IsLimitedBeforeAParserRecurses) {
    const TemporaryFolder folder;
    const auto refuse = [&](const std::string& text, const std::string& place) {
        const std::string path = folder.write("deep.toml", text);
        expect_error([&] { read_toml(path); }, ExitCode::bad_file, {path + place, "nested too deep"});
    };
    std::string dots = "a";
    for (int i = 0; i < 100'000; ++i) dots += i % 2 ? ".a" : " . 'b.c'";
    refuse("x = 1\n" + dots + " = 1", ":2:");
    refuse("[" + dots + "]\n", ":1:");
    refuse("[[" + dots + "]]\n", ":1:");
    refuse("a = " + std::string(100'000, '['), ":1:");
    for (const std::string quotes : {"\"\"\"", "'''"}) {  // texts that end with a quotation mark or two of their own
        for (const std::size_t own : {1, 2}) {
            refuse("x = {k = " + quotes + "a" + quotes + std::string(own, quotes[0]) + ", " + dots + " = 1}", ":1:");
        }
    }
    std::string tables = "a = ";
    for (int i = 0; i < 100'000; ++i) tables += "{a = ";
    refuse(tables, ":1:");
}

TEST(TomlDepth, IsNotCountedInTextsAndComments) {
    const TemporaryFolder folder;
    const std::string dots(100, '.'), brackets(100, '[');
    Node file = read_toml(folder.write("flat.toml", "# " + dots + brackets + "\na = \"" + dots + "\\\"" + brackets +
                                                        "\"\nb = '" + dots + "'\nc = '''\n" + brackets + "'" + dots +
                                                        "\n'''\nd = \"\"\"" + brackets +
                                                        "\\\"\"\"\"\ne.f.g = [1.5, 2.5, -3.5]\n"));
    EXPECT_EQ(std::get<std::string>(file.find("b")->value), dots);
    EXPECT_NE(file.find("e"), nullptr);
}

TEST(TomlBases, AreAFew) {
    const TemporaryFolder folder;
    for (int i = 0; i < 40; ++i) {
        folder.write(std::to_string(i) + ".toml", "base = \"" + std::to_string(i + 1) + ".toml\"\n");
    }
    folder.write("40.toml", "x = 1\n");
    EXPECT_NO_THROW(read_toml(folder / "30.toml"));
    expect_error([&] { read_toml(folder / "0.toml"); }, ExitCode::bad_file, {"at most 16 files"});
}

}  // namespace
}  // namespace hamilcar::io
