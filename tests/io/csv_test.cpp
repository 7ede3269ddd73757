// Tables as comma-separated text, and their fields again.
#include "hamilcar/io/csv.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hamilcar::io {
namespace {

TEST(CsvText, HasARowForEveryRow) {
    CsvText table({"name", "x [m]"});
    table.cell("front").cell(1.0 / 3, 4).end_row();
    table.cell("rear").cell(0.1).end_row();
    EXPECT_EQ(table.text(), "name,x [m]\nfront,0.3333\nrear,0.1\n");
}

TEST(CsvText, LeavesEmptyWhatIsNoNumber) {
    CsvText table({"a", "b", "c"});
    table.cell(std::numeric_limits<double>::quiet_NaN())
        .cell("")
        .cell(std::numeric_limits<double>::infinity(), 3)
        .end_row();
    EXPECT_EQ(table.text(), "a,b,c\n,,\n");
}

TEST(CsvText, FieldsWithASeparatorOrAQuotationMarkAreQuoted) {
    CsvText table({"a, b", "say \"c\""});
    EXPECT_EQ(table.text(), "\"a, b\",\"say \"\"c\"\"\"\n");
}

TEST(CsvFields, MayBeQuotedAndHaveAnySeparator) {
    using Fields = std::vector<std::string_view>;
    EXPECT_EQ(csv_fields("a, b ,c", ','), (Fields{"a", "b", "c"}));
    EXPECT_EQ(csv_fields("\"a;b\";c", ';'), (Fields{"a;b", "c"}));
    EXPECT_EQ(csv_fields("", ','), (Fields{""}));
    EXPECT_EQ(csv_fields("a,", ','), (Fields{"a", ""}));
}

}  // namespace
}  // namespace hamilcar::io
