// A client on plain sockets, so that the server is not tested with the library that it is built on.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace hamilcar::live {

class SocketClient {
public:
    // `receive_buffer`: size of the system's buffer, small to fill it soon; zero: the default [byte].
    explicit SocketClient(std::uint16_t port, int receive_buffer = 0) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
        if (receive_buffer > 0) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    }
    SocketClient(SocketClient&& other) noexcept
        : socket_(std::exchange(other.socket_, -1)), received_(std::move(other.received_)) {}
    SocketClient& operator=(SocketClient&&) = delete;
    ~SocketClient() {
        if (socket_ >= 0) close(socket_);
    }

    void send(const std::string& bytes) const {
        for (std::size_t sent = 0; sent < bytes.size();) {
            const auto count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (count <= 0) return;  // the server has closed; the test notices when it reads
            sent += static_cast<std::size_t>(count);
        }
    }

    // Everything until the server closes.
    std::string rest() {
        while (receive()) {}
        return std::exchange(received_, {});
    }

    // Up to the empty line after an HTTP header.
    std::string header() {
        while (received_.find("\r\n\r\n") == std::string::npos && receive()) {}
        return take(std::min(received_.size(), received_.find("\r\n\r\n") + 4));
    }

    // A frame as a client sends it, masked (RFC 6455).
    void send_frame(int opcode, const std::string& payload) const {
        constexpr int masked = 0x80, two_bytes = 126;
        std::string bytes{static_cast<char>(0x80 | opcode)};
        if (payload.size() < two_bytes) {
            bytes += static_cast<char>(masked | static_cast<int>(payload.size()));
        } else {
            bytes += static_cast<char>(masked | two_bytes);
            bytes += static_cast<char>(payload.size() >> 8);
            bytes += static_cast<char>(payload.size() & 0xff);
        }
        const std::string key = "\x11\x22\x33\x44";
        bytes += key;
        for (std::size_t i = 0; i < payload.size(); ++i) bytes += static_cast<char>(payload[i] ^ key[i % 4]);
        send(bytes);
    }
    void send_text(const std::string& text) const { send_frame(1, text); }

    struct Frame {
        int opcode;
        std::string payload;
    };
    // The next one, or none if the connection is closed.
    std::optional<Frame> frame() {
        constexpr std::size_t two_bytes = 126;
        if (!have(2)) return std::nullopt;
        std::size_t size = received_[1] & 0x7f, header = 2;
        if (size >= two_bytes) {
            const std::size_t bytes = size == two_bytes ? 2 : 8;
            if (!have(header + bytes)) return std::nullopt;
            size = 0;
            for (std::size_t i = 0; i < bytes; ++i) size = size << 8 | static_cast<unsigned char>(received_[2 + i]);
            header += bytes;
        }
        if (!have(header + size)) return std::nullopt;
        const int opcode = received_[0] & 0x0f;
        take(header);
        return Frame{opcode, take(size)};
    }

    // The next text that contains both strings, or "" if none arrives within half a minute.
    std::string text_with(const std::string& what, const std::string& and_what = "") {
        for (auto next = frame(); next; next = frame()) {
            const bool found = next->opcode == 1 && next->payload.find(what) != std::string::npos;
            if (found && next->payload.find(and_what) != std::string::npos) return next->payload;
        }
        return "";
    }
    // The code that the server closes with, or 0.
    int close_code() {
        for (auto next = frame(); next; next = frame()) {
            if (next->opcode != 8 || next->payload.size() < 2) continue;
            return static_cast<unsigned char>(next->payload[0]) << 8 | static_cast<unsigned char>(next->payload[1]);
        }
        return 0;
    }

private:
    bool have(std::size_t size) {
        while (received_.size() < size) {
            if (!receive()) return false;
        }
        return true;
    }
    bool receive() {
        constexpr int timeout_ms = 30000;
        pollfd ready{socket_, POLLIN, 0};
        if (poll(&ready, 1, timeout_ms) <= 0) return false;
        char bytes[16384];
        const auto count = recv(socket_, bytes, sizeof bytes, 0);
        if (count <= 0) return false;
        received_.append(bytes, static_cast<std::size_t>(count));
        return true;
    }
    std::string take(std::size_t size) {
        const std::string bytes = received_.substr(0, size);
        received_.erase(0, size);
        return bytes;
    }

    int socket_;
    std::string received_;
};

}  // namespace hamilcar::live
