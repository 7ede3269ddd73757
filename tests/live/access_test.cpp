// Access control, without a network.
#include "hamilcar/live/access.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hamilcar::live {
namespace {

const Secrets secrets{.token = "secret", .once = "once", .session = "client", .folder = "place"};
const Access access(secrets, 8080);

HttpRequest entrance() {
    return {.method = "GET", .target = "/?token=secret", .host = "127.0.0.1:8080"};
}
HttpRequest page() {
    return {.method = "GET", .target = "/place/", .host = "127.0.0.1:8080", .cookie = "hamilcar=client"};
}
HttpRequest link() {
    return {.method = "GET",
            .target = "/place/live",
            .host = "localhost:8080",
            .origin = "http://localhost:8080",
            .cookie = "hamilcar=client",
            .upgrade = true};
}

TEST(Access, EntranceRequiresToken) {
    EXPECT_EQ(access.judge(entrance()), 200);
    EXPECT_EQ(access.url(), "http://127.0.0.1:8080/?token=secret");
    for (const char* target :
         {"/", "/?", "/?token=", "/?token=secre", "/?token=secrets", "/?token=SECRET", "/?other=secret", "/?token",
          "/?token=wrong&token=secret", "/?token=client", "/?token=place", "/?xtoken=secret"}) {
        HttpRequest request = entrance();
        request.target = target;
        EXPECT_EQ(access.judge(request), 403) << target;
        request.cookie = "hamilcar=client";  // opens the page, not the entrance
        EXPECT_EQ(access.judge(request), 403) << target;
    }
    HttpRequest further = entrance();
    further.target = "/?theme=dark&token=secret&x";
    EXPECT_EQ(access.judge(further), 200);
}

TEST(Access, TokenOfTheOwnBrowserIsGoodOnce) {
    Access own(secrets, 8080);
    EXPECT_EQ(own.url_once(), "http://127.0.0.1:8080/?token=once");
    HttpRequest request = entrance();
    request.target = "/?token=once";
    EXPECT_EQ(own.judge(request), 200);
    own.entered("/?token=secret");
    EXPECT_EQ(own.judge(request), 200);
    own.entered(request.target);
    for (const char* target : {"/?token=once", "/?token=", "/"}) {
        request.target = target;
        EXPECT_EQ(own.judge(request), 403) << target;
    }
    EXPECT_EQ(own.judge(entrance()), 200);
}

TEST(Access, PageAndLinkRequireTheCookie) {
    EXPECT_EQ(access.judge(page()), 200);
    EXPECT_EQ(access.judge(link()), 101);
    EXPECT_EQ(access.cookie(), "hamilcar=client; Path=/place/; HttpOnly; SameSite=Strict");
    for (const char* cookie : {"", "hamilcar", "hamilcar=", "hamilcar=clien", "hamilcar=clients", "hamilcar=secret",
                               "other=client", "xhamilcar=client", "hamilcar=wrong; hamilcar=client"}) {
        for (HttpRequest request : {page(), link()}) {
            request.cookie = cookie;
            EXPECT_EQ(access.judge(request), 403) << cookie;
            request.target = request.upgrade ? "/place/live?token=secret" : "/place/?token=secret";
            EXPECT_EQ(access.judge(request), 403) << cookie;
        }
    }
    HttpRequest further = page();
    further.cookie = "theme=dark; hamilcar=client; x";
    EXPECT_EQ(access.judge(further), 200);
}

// Nothing that opens anything stays in the address.
TEST(Access, EntranceLeadsToTheFolder) {
    const std::string text = access.entrance_page();
    EXPECT_NE(text.find("content=\"0; url=/place/\""), std::string::npos) << text;
    for (const char* secret : {"secret", "once", "client"}) EXPECT_EQ(text.find(secret), std::string::npos) << secret;
}

TEST(Access, AllowsTheScriptsThatThePageNames) {
    const std::string named =
        "<head><meta http-equiv=\"Content-Security-Policy\" content=\"script-src 'sha256-x='; style-src 'sha256-y='\" "
        "/>";
    EXPECT_EQ(inline_policy_of(named + "<script>"), "script-src 'sha256-x='; style-src 'sha256-y='");
    EXPECT_EQ(inline_policy_of("<script></script>" + named), "");  // a document's text, say
    EXPECT_EQ(inline_policy_of("<head></head>"), "");
    const std::string policy = access.content_security_policy(inline_policy_of(named));
    EXPECT_NE(policy.find("default-src 'none'; script-src 'sha256-x='; style-src 'sha256-y='; img-src"),
              std::string::npos)
        << policy;
    EXPECT_EQ(policy.find("unsafe"), std::string::npos);
    EXPECT_EQ(access.content_security_policy("").find("script-src"), std::string::npos);
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
    for (const char* target : {"", "/favicon.ico", "/live", "/place", "/place/live/", "/place/live2", "/other/", "//",
                               "/../etc/passwd", "http://127.0.0.1:8080/", "*"}) {
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
    EXPECT_FALSE(same_secret("", ""));
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
