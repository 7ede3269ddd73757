// Access control, without a network.
#include "hamilcar/live/access.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hamilcar::live {
namespace {

const Access access("secret", 8080);

HttpRequest page() {
    return {.method = "GET", .target = "/?token=secret", .host = "127.0.0.1:8080"};
}
HttpRequest link() {
    return {.method = "GET",
            .target = "/live?token=secret",
            .host = "localhost:8080",
            .origin = "http://localhost:8080",
            .upgrade = true};
}

TEST(Access, RequiresToken) {
    EXPECT_EQ(access.judge(page()), 200);
    EXPECT_EQ(access.judge(link()), 101);
    EXPECT_EQ(access.url(), "http://127.0.0.1:8080/?token=secret");
    for (const char* target : {"/", "/?", "/?token=", "/?token=secre", "/?token=secrets", "/?token=SECRET",
                               "/?other=secret", "/?token", "/?token=wrong&token=secret"}) {
        HttpRequest request = page();
        request.target = target;
        EXPECT_EQ(access.judge(request), 403) << target;
    }
    HttpRequest further = page();
    further.target = "/?theme=dark&token=secret&x";
    EXPECT_EQ(access.judge(further), 200);
}

TEST(Access, RejectsOtherHosts) {
    for (const char* host : {"", "127.0.0.1", "127.0.0.1:8081", "evil.example:8080", "127.0.0.1:8080.evil.example",
                             "[::1]:8080", "LOCALHOST:8080"}) {
        HttpRequest request = page();
        request.host = host;
        EXPECT_EQ(access.judge(request), 403) << host;
    }
}

TEST(Access, LinkRequiresOwnOrigin) {
    for (const char* origin : {"", "null", "http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1",
                               "http://127.0.0.1:80801", "file://"}) {
        HttpRequest request = link();
        request.origin = origin;
        EXPECT_EQ(access.judge(request), 403) << origin;
    }
    HttpRequest plain = link();
    plain.upgrade = false;
    EXPECT_EQ(access.judge(plain), 426);
}

TEST(Access, AllowsTwoPathsAndTwoMethods) {
    HttpRequest request = page();
    request.method = "HEAD";
    EXPECT_EQ(access.judge(request), 200);
    for (const char* method : {"POST", "PUT", "OPTIONS", "get", ""}) {
        request.method = method;
        EXPECT_EQ(access.judge(request), 405) << method;
    }
    request = page();
    for (const char* target : {"", "/favicon.ico", "/live/", "//", "/../etc/passwd", "http://127.0.0.1:8080/", "*"}) {
        request.target = target;
        EXPECT_EQ(access.judge(request), 404) << target;
    }
}

TEST(Access, RefusalMentionsTheNewAddress) {
    EXPECT_NE(refusal_text(403, "Forbidden").find("open the address that it printed."), std::string::npos);
    EXPECT_EQ(refusal_text(404, "Not Found"), "Not Found\n");
}

TEST(SameSecret, ComparesWholeStrings) {
    EXPECT_TRUE(same_secret("abc", "abc"));
    for (const char* given : {"", "ab", "abd", "abcd", "abcabc"}) EXPECT_FALSE(same_secret(given, "abc")) << given;
    EXPECT_FALSE(same_secret("abc", ""));
}

TEST(RandomToken, IsUniqueHexadecimal) {
    std::set<std::string> seen;
    for (int i = 0; i < 100; ++i) {
        const std::string token = random_token();
        EXPECT_EQ(token.size(), 32u);
        EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
        EXPECT_TRUE(seen.insert(token).second);
    }
}

}  // namespace
}  // namespace hamilcar::live
