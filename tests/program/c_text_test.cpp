#include "hamilcar/program/c_text.hpp"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "hamilcar/program/pass.hpp"
#include "program/running.hpp"

namespace hamilcar::program {
namespace {

using namespace test;
using ::testing::HasSubstr;

// A folder of its own, gone with it.
class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "hamilcar_c_text_XXXXXX").string();
        path_ = mkdtemp(name.data()) == nullptr ? "" : name;
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

template <class Number>
using Function = void (*)(Number* const* arrays, const CallFunction* functions, const void* context);

template <class Number>
void expect_same_bits(void* library, const std::string& name, const Graph& graph) {
    const auto function = reinterpret_cast<Function<Number>>(dlsym(library, name.c_str()));
    ASSERT_NE(function, nullptr) << name;
    for (unsigned seed = 0; seed < 8; ++seed) {
        const Arrays<Number> found(graph, 1, seed), expected(graph, 1, seed);
        std::array<Number*, max_arrays> arrays{};
        for (std::size_t i = 0; i < max_arrays; ++i) arrays[i] = static_cast<Number*>(found.frame().arrays[i]);
        function(arrays.data(), found.frame().functions, found.frame().context);
        PlainEvaluator<Number>(graph, 1, expected.frame()).run();
        ASSERT_TRUE(same_outputs<Number>(graph, 1, found.outputs(), expected.outputs())) << name << ", seed " << seed;
    }
}

// Every special number as a constant, on either side of what may be done with it.
Graph graph_of_constants(Precision precision) {
    Graph graph(precision);
    int index = 0;
    for (const double special : special_numbers<double>()) {
        const Id constant = graph.constant(special), x = graph.input(0, index % 5), y = graph.input(1, index % 3);
        graph.output(output_array, index++, constant);
        for (const Op op : {Op::add, Op::subtract, Op::multiply, Op::divide, Op::minimum, Op::maximum}) {
            graph.output(output_array, index++, graph.add(op, x, constant));
            graph.output(output_array, index++, graph.add(op, constant, x));
        }
        for (const Op op : {Op::less, Op::less_equal, Op::equal, Op::not_less, Op::not_less_equal, Op::not_equal}) {
            graph.output(output_array, index++, graph.add(Op::select, graph.add(op, x, constant), constant, y));
        }
    }
    return graph;
}

TEST(CText, ComputesTheSameBitsAsTheGraph) {
    if (std::system("cc --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no C compiler";
    std::vector<Graph> graphs;
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
        graphs.push_back(graph_of_constants(precision));
        for (unsigned seed = 0; seed < 30; ++seed) {
            graphs.push_back(random_graph(seed, {.precision = precision, .size = 20 + static_cast<int>(seed) * 5}));
        }
    }
    const Folder folder;
    const std::string source = folder.path() / "functions.c", library_file = folder.path() / "functions.so";
    std::ofstream file(source);
    for (std::size_t i = 0; i < graphs.size(); ++i) file << c_text(graphs[i], "function_" + std::to_string(i)) << "\n";
    file.close();
    const std::string command =
        "cc -std=c99 -pedantic -Wall -Wno-unused -Werror -O2 -ffp-contract=off -shared -fPIC -o " + library_file + " " +
        source + " -lm";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    void* library = dlopen(library_file.c_str(), RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(library, nullptr) << dlerror();
    for (std::size_t i = 0; i < graphs.size(); ++i) {
        const std::string name = "function_" + std::to_string(i);
        const Graph single =
            in_single_numbers(graphs[i]);  // which may fold more: the sign of a zero may differ from the graph's
        single.precision() == Precision::double_precision ? expect_same_bits<double>(library, name, single)
                                                          : expect_same_bits<float>(library, name, single);
    }
    dlclose(library);
}

TEST(CText, ExplainsItsArguments) {
    Graph graph;
    const std::array arguments{graph.add(Op::add, graph.input(0, 2), graph.input(0, 3)), graph.input(3, 7)};
    graph.output(5, 1, graph.call(2, 40, arguments, 1));
    const std::string text = c_text(graph, "wheel_rates");
    EXPECT_THAT(text, HasSubstr("void wheel_rates("));
    EXPECT_THAT(text, HasSubstr("arrays[0]: reads 2 to 3."));
    EXPECT_THAT(text, HasSubstr("arrays[3]: reads 7."));
    EXPECT_THAT(text, HasSubstr("arrays[5]: writes 1."));
    EXPECT_THAT(text, HasSubstr("It calls 2."));
    EXPECT_THAT(text, HasSubstr("-ffp-contract=off"));
    EXPECT_EQ(text.find("#include"), std::string::npos);
}

TEST(CText, LosesNoDigit) {
    Graph graph;
    graph.output(0, 0, graph.constant(0.1));
    EXPECT_THAT(c_text(graph, "tenth"), HasSubstr("0x1.999999999999ap-4"));
}

}  // namespace
}  // namespace hamilcar::program
