// A property file gives back every pair and table with its line, and a mistake in it is told with that line.
#include "hamilcar/io/property_file.hpp"

#include "tests/io/files.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

PropertyFile parsed(const std::string& text) {
    return parse_property_file(text, "a.tir");
}

// Of the only pair in a section.
PropertyEntry entry_of(const std::string& pair) {
    const PropertyFile file = parsed("[A]\n" + pair + "\n");
    EXPECT_EQ(file.sections.front().entries.size(), 1u) << pair;
    return file.sections.front().entries.front();
}

void expect_mistake(const std::string& text, const std::vector<std::string>& pieces) {
    expect_error([&] { parsed(text); }, ExitCode::bad_file, pieces);
}

const std::string tire = R"($------------------------------------------------------------------MDI_HEADER
[MDI_HEADER]
FILE_TYPE     ='tir'
FILE_VERSION  =3.0
! : COMMENT : isn't a pair
(COMMENTS)
{comment_string}
'Tire = 205/60 R15 $ 91V'
$----------------------------------------------------------------units
[UNITS]
LENGTH = 'mm'   $ don't stop
MASS   = "kg"
$-----------------------------------------------------------------shape
[SHAPE]
{radial width}
 1.0    0.0
 1.0    0.4
 0.9,   1.0   ! the last
[INERTIA]
MASS = 9.3
)";

TEST(PropertyFile, HasItsSectionsInOrder) {
    const PropertyFile file = parsed(tire);
    std::vector<std::string> names;
    std::vector<std::size_t> lines;
    for (const PropertySection& section : file.sections) {
        names.push_back(section.name);
        lines.push_back(section.line);
    }
    EXPECT_THAT(names, ElementsAre("MDI_HEADER", "MDI_HEADER/COMMENTS", "UNITS", "SHAPE", "INERTIA"));
    EXPECT_THAT(lines, ElementsAre(2, 6, 10, 14, 19));
    EXPECT_EQ(file.path, "a.tir");
}

TEST(PropertyFile, FindsAPairWithItsLine) {
    const PropertyFile file = parsed(tire);
    const PropertyEntry* type = file.find("MDI_HEADER", "FILE_TYPE");
    ASSERT_TRUE(type);
    EXPECT_EQ(type->text, "tir");
    EXPECT_TRUE(type->quoted);
    EXPECT_FALSE(type->number);
    EXPECT_EQ(type->line, 3u);
    const PropertyEntry* version = file.find("MDI_HEADER", "FILE_VERSION");
    ASSERT_TRUE(version);
    EXPECT_EQ(version->text, "3.0");
    EXPECT_FALSE(version->quoted);
    EXPECT_EQ(version->number, 3.0);
    EXPECT_EQ(version->line, 4u);
    EXPECT_FALSE(file.find("MDI_HEADER", "LENGTH"));
    EXPECT_FALSE(file.find("VERTICAL", "LENGTH"));
    EXPECT_FALSE(file.find("VERTICAL"));
}

TEST(PropertyFile, KeepsTheSameKeyOfTwoSectionsApart) {
    const PropertyFile file = parsed(tire);
    EXPECT_EQ(file.find("UNITS", "MASS")->text, "kg");
    EXPECT_EQ(file.find("INERTIA", "MASS")->number, 9.3);
}

TEST(PropertyFile, ReadsATable) {
    const PropertyFile file = parsed(tire);
    const PropertySection& shape = *file.find("SHAPE");
    EXPECT_THAT(shape.columns, ElementsAre("radial", "width"));
    EXPECT_THAT(shape.rows, ElementsAre(ElementsAre(1.0, 0.0), ElementsAre(1.0, 0.4), ElementsAre(0.9, 1.0)));
    EXPECT_EQ(shape.table_line, 15u);
    EXPECT_THAT(shape.entries, IsEmpty());
}

TEST(PropertyFile, ReadsATableWithoutHeaderBesidesPairs) {
    const PropertyFile file = parsed("[CURVE]\nSCALE = 2\n-10\t-1D2\n\n+10 +1e2\n");
    const PropertySection& curve = *file.find("CURVE");
    EXPECT_THAT(curve.columns, IsEmpty());
    EXPECT_THAT(curve.rows, ElementsAre(ElementsAre(-10, -100), ElementsAre(10, 100)));
    EXPECT_EQ(curve.table_line, 3u);
    EXPECT_EQ(file.find("CURVE", "SCALE")->number, 2.0);
}

TEST(PropertyFile, ReadsASubBlockAsASectionOfItsOwn) {
    const PropertyFile file =
        parsed("[damper]\nA = 1\n(z_curve) $ of the wheel\nA = 2\n{ vel force }\n1 2\n(OTHER)\n1\n");
    EXPECT_EQ(file.find("DAMPER", "A")->number, 1.0);
    EXPECT_EQ(file.find("DAMPER/Z_CURVE", "A")->number, 2.0);
    EXPECT_THAT(file.find("DAMPER/Z_CURVE")->rows, ElementsAre(ElementsAre(1, 2)));
    EXPECT_THAT(file.find("DAMPER/OTHER")->rows, ElementsAre(ElementsAre(1)));
}

TEST(PropertyFile, TakesALineThatIsOnlyAQuotedTextAsAnEntryWithoutKey) {
    const PropertyFile file = parsed(tire);
    const PropertySection& comments = *file.find("MDI_HEADER/COMMENTS");
    EXPECT_THAT(comments.columns, ElementsAre("comment_string"));
    ASSERT_EQ(comments.entries.size(), 1u);
    EXPECT_EQ(comments.entries.front().key, "");
    EXPECT_EQ(comments.entries.front().text, "Tire = 205/60 R15 $ 91V");
    EXPECT_EQ(parsed("[A]\n'x'\n'x'\n").find("A")->entries.size(), 2u);
}

TEST(PropertyFile, GoesOnWithASectionThatIsOpenedAgain) {
    const PropertyFile file = parsed("[A]\nX = 1\n[B]\nX = 2\n[a]\nY = 3\n");
    ASSERT_EQ(file.sections.size(), 2u);
    EXPECT_EQ(file.find("A")->line, 1u);
    EXPECT_EQ(file.find("A", "X")->number, 1.0);
    EXPECT_EQ(file.find("A", "Y")->number, 3.0);
    EXPECT_EQ(file.find("A", "Y")->line, 6u);
}

TEST(PropertyFile, NormalizesSectionsAndKeysToUpperCase) {
    const PropertyFile file = parsed("[ Vertical ] $ load\n fnoMin=4000\n");
    EXPECT_EQ(file.find("VERTICAL", "FNOMIN")->number, 4000.0);
}

TEST(PropertyNumber, MayHaveAFortranExponent) {
    EXPECT_EQ(entry_of("X = 1.5D-3").number, 0.0015);
    EXPECT_EQ(entry_of("X = 1.5d-3").number, 0.0015);
    EXPECT_EQ(entry_of("X = -.100000E+01").number, -1.0);
    EXPECT_EQ(entry_of("X = 2.1e+005").number, 210000.0);
    EXPECT_EQ(entry_of("X = 1.D0").number, 1.0);
    EXPECT_EQ(entry_of("X = +2").number, 2.0);
    EXPECT_EQ(entry_of("X=-0").number, 0.0);
}

TEST(PropertyNumber, IsAWholeFiniteNumberOrNone) {
    for (const char* text :
         {"LEFT", "nan", "inf", "-inf", "1.5x", "1 2", "0x10", "1e999", ".", "-", "+-1", "1e", "3 {mm}"}) {
        const PropertyEntry entry = entry_of(std::string("X = ") + text);
        EXPECT_EQ(entry.number, std::nullopt) << text;
        EXPECT_EQ(entry.text, text);
        EXPECT_FALSE(entry.quoted);
    }
}

TEST(PropertyValue, EndsAtACommentOrTrailingComma) {
    EXPECT_EQ(entry_of("X = 1.5$typarr( 7)").number, 1.5);
    EXPECT_EQ(entry_of("X = 1.5 ! isn't 'closed").number, 1.5);
    EXPECT_EQ(entry_of("X = 1.5, $ next").number, 1.5);
    EXPECT_EQ(entry_of("X = LEFT ,").text, "LEFT");
    EXPECT_EQ(entry_of("X = 'mm',  ! x").text, "mm");
}

TEST(PropertyValue, KeepsCommentMarksInsideQuotes) {
    EXPECT_EQ(entry_of("X = ' a$b!c=d ' $ e").text, "a$b!c=d");
    EXPECT_EQ(entry_of("X = \"it's\"").text, "it's");
    EXPECT_EQ(entry_of("X = ''").text, "");
    EXPECT_TRUE(entry_of("X = ''").quoted);
}

TEST(PropertyValue, MayBeEmpty) {
    for (const char* pair : {"MFSAFE3 =", "MFSAFE3 = $ nothing", "MFSAFE3 =\t"}) {
        const PropertyEntry entry = entry_of(pair);
        EXPECT_EQ(entry.key, "MFSAFE3");
        EXPECT_EQ(entry.text, "");
        EXPECT_FALSE(entry.quoted);
        EXPECT_EQ(entry.number, std::nullopt);
    }
}

TEST(PropertyText, MayHaveAnyLineEnds) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const PropertyFile file = parsed("[A]" + end + end + "X = 1" + end + "\tY\t=\t2\t");
        EXPECT_EQ(file.find("A", "X")->number, 1.0);
        EXPECT_EQ(file.find("A", "X")->line, 3u);
        EXPECT_EQ(file.find("A", "Y")->number, 2.0);
        EXPECT_EQ(file.find("A", "Y")->line, 4u);
    }
}

TEST(PropertyText, MayHaveAByteOrderMarkLatin1AndAnEndOfFileMark) {
    const PropertyFile file = parsed(
        "\xEF\xBB\xBF[A]\n! M\xFCller\nX = 'Stra\xDF"
        "e' $ \xE9\n\x1a");
    EXPECT_EQ(file.find("A", "X")->text,
              "Stra\xDF"
              "e");
    EXPECT_EQ(file.find("A", "X")->line, 3u);
}

TEST(PropertyText, MayBeEmpty) {
    EXPECT_THAT(parsed("").sections, IsEmpty());
    EXPECT_THAT(parsed("\n$ only a comment").sections, IsEmpty());
}

TEST(PropertyMistake, NamesItsLine) {
    expect_mistake("(X)\n", {"a.tir:1: sub-block '(X)': expected a [section] first"});
    expect_mistake("$\n[A\n", {"a.tir:2: '[A': expected a section to end with ']'"});
    expect_mistake("[ ]\n", {"a.tir:1: ", "expected a section with a name"});
    expect_mistake("[A]\n(B\n", {"a.tir:2: '(B': expected a sub-block to end with ')'"});
    expect_mistake("[A]\n{x y\n", {"a.tir:2: '{x y': expected a table's header to end with '}'"});
}

// What other programs pass over is left out, and noted with its line.
TEST(PropertyNote, NamesWhatIsLeftOutWithItsLine) {
    struct Oddity {
        std::string text;
        std::size_t line;
        std::string note;
    };
    for (const Oddity& odd : std::vector<Oddity>{
             {"\nX = 1\n[A]\nY = 2\n", 2, "'X = 1' before the first [section] is not used"},
             {"[A] B\nY = 2\n", 1, "'B' behind a section is not used"},
             {"[A]\nFNOMIN 4000\nY = 2\n", 2,
              "'FNOMIN 4000' is not used: it is neither KEY = value nor a row of numbers"},
             {"[A]\nX $ = 3\nY = 2\n", 2, "'X' is not used: it is neither"},
             {"[A]\n= 4\nY = 2\n", 2, "'' before '=' is not used: it is no key of one word"},
             {"[A]\nX [mm] = 4\nY = 2\n", 2, "'X [mm]' before '=' is not used"},
             {"[A]\r\rX = 'left $ side\rY = 2\r", 3, "''left $ side' has no closing '"},
             {"[A]\r\nX = 'a' b\r\nY = 2\r\n", 2, "'b' behind the closing quotation mark is not used"},
             {"[A]\nY = 2\n{x y}\n1 2\n1 2 3\n3 4\n", 5, "a row of 3 is not used: the table's header, line 3, has 2"},
             {"[A]\nY = 2\n1 2\n1\n3 4\n", 4, "a row of 1 is not used: the table's first row, line 3, has 2"},
             {"[A]\nY = 2\n1 2\n3 four\n3 4\n", 4, "the row with 'four' is not used: that is no number"},
             {"[A]\nY = 2\n{x y}\n1 2\n3 4\n{z}\n2\n", 6, "a second table of [A] is not used, only that at line 3"},
             {"[A]\nY = 2,5\n", 2, "Y = '2,5' is read as 2.5"}}) {
        SCOPED_TRACE(odd.text);
        const PropertyFile file = parsed(odd.text);
        ASSERT_EQ(file.notes.size(), 1u);
        EXPECT_EQ(file.notes[0].line, odd.line);
        EXPECT_THAT(file.notes[0].text, testing::StartsWith(odd.note));
        EXPECT_THAT(file.find("A", "Y")->number, testing::AnyOf(2.0, 2.5)) << "the rest is read";
        if (file.find("A")->table_line != 0) {
            EXPECT_THAT(file.find("A")->rows, ElementsAre(ElementsAre(1, 2), ElementsAre(3, 4)));
        }
    }
    EXPECT_EQ(parsed("[A]\nX = 'left $ side\n").find("A", "X")->text, "left");
    EXPECT_THAT(parsed("[A]\nX = 1,000.5\n").find("A", "X")->number, testing::Eq(std::nullopt));
    EXPECT_EQ(parsed(std::string("[A]\n") +
                     [] {
                         std::string many;
                         for (int i = 0; i < 3000; ++i) many += "x\n";
                         return many;
                     }())
                  .notes.size(),
              1000u);
}

TEST(PropertyFile, KeepsAKeyGivenTwiceAndFindsTheFirst) {
    const PropertyFile file = parsed("[A]\nX = 1\nY = 2\nx = 3\n");
    EXPECT_EQ(file.find("A", "X")->number, 1.0);
    EXPECT_EQ(file.find("A")->entries.size(), 3u);
}

TEST(PropertyText, MayBeUtf16) {
    const std::string plain = "[A]\r\nX = '\xFC' $ ?\r\nY = 4\r\n";
    std::string little = "\xFF\xFE", big = "\xFE\xFF";
    for (const char c : plain) {
        little += {c, c == '?' ? '\x20' : '\0'};  // a character beyond Latin-1
        big += {c == '?' ? '\x20' : '\0', c};
    }
    for (const std::string& text : {little, big, little + "x"}) {
        EXPECT_EQ(parsed(text).find("A", "X")->text, "\xFC");
        EXPECT_EQ(parsed(text).find("A", "Y")->number, 4.0);
        EXPECT_EQ(parsed(text).find("A", "Y")->line, 3u);
    }
}

TEST(PropertyValue, MayBeANumberInQuotationMarks) {
    EXPECT_EQ(parsed("[A]\nX = '4000'\n").find("A", "X")->number, 4000.0);
}

TEST(PropertyNote, ShowsNoBytesATerminalCouldTripOver) {
    const std::string text = "[A]\n\xFC\x1b[2J " + std::string(1000, 'x') + "\n";
    EXPECT_THAT(parsed(text).notes.at(0).text,
                testing::AllOf(testing::StartsWith("'??[2J xxx"), testing::HasSubstr("xxx...'")));
}

TEST(PropertyFile, IsReadFromDisk) {
    const TemporaryFolder folder;
    const std::string path = folder.write("car.tir", tire);
    const PropertyFile file = read_property_file(path);
    EXPECT_EQ(file.path, path);
    EXPECT_EQ(file.find("INERTIA", "MASS")->number, 9.3);
}

TEST(PropertyFile, ThatCannotBeReadIsAnInputError) {
    const TemporaryFolder folder;
    expect_error([&] { read_property_file(folder / "none.tir"); }, ExitCode::input_output,
                 {"none.tir: cannot read: No such file or directory"});
    expect_error([&] { read_property_file(folder / "."); }, ExitCode::input_output, {"cannot read: Is a directory"});
    expect_error([&] { read_property_file("/dev/zero"); }, ExitCode::input_output,
                 {"/dev/zero: cannot read: is a device, expected a regular file"});
}

TEST(PropertyFile, OfTheLargestSizeIsReadInTimeThatGrowsWithIt) {
    std::string text = "[A]\n";
    for (int i = 0; text.size() + 20 < 4'000'000; ++i) text += "[S" + std::to_string(i) + "]\nX=1\n";
    EXPECT_GT(parsed(text).sections.size(), 200'000u);
}

}  // namespace
}  // namespace hamilcar::io
