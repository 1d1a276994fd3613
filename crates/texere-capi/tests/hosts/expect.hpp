// What the tests of texere.hpp share: a condition that has to hold, and an exception that has to come.
#include <cstdio>
#include <cstdlib>

#include "texere.hpp"

#define CHECK(what) \
    if (!(what)) std::printf("line %d: %s\n", __LINE__, #what), std::exit(1)

template <class Call>
static texere::Error thrown(Call call) {
    try {
        call();
    } catch (const texere::Error &error) {
        return error;
    }
    std::puts("nothing was thrown");
    std::exit(1);
}

using Bytes = std::vector<std::uint8_t>;
