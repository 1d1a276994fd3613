// Yarns of the program's own, a ring and a straight yarn: saved in a file, read again, and planned as a mesh on the CPU.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "texere.h"

static void check(enum texere_status status) {
    if (status == TEXERE_OK) return;
    fprintf(stderr, "%s\n", texere_error_message());
    exit(status);
}

int main(int count, char **arguments) {
    if (count != 2) return 1;
    const struct texere_point points[] = {
        {0, 0, 0, .1f, .1f}, {1, 0, 0, .1f, .1f}, {1, 1, 0, .1f, .1f}, {0, 1, 0, .1f, .1f},
        {-1, .5f, 1, .2f, .1f}, {0, .5f, 1, .2f, .1f}, {2, .5f, 1, .2f, .1f},
    };
    const uint64_t offsets[] = {0, 4, 7};
    const uint8_t closed[] = {1, 0};
    const struct texere_yarn_arrays arrays = {
        .struct_size = sizeof arrays, .yarns = 2, .offsets = offsets, .points = points, .closed = closed};
    struct texere_yarns *yarns, *saved;
    check(texere_yarns_new(&arrays, &yarns));
    check(texere_yarns_write(yarns, arguments[1], strlen(arguments[1])));
    check(texere_yarns_read(arguments[1], strlen(arguments[1]), &saved));

    struct texere_device *device;
    check(texere_device_open("cpu", 3, &device));
    struct texere_settings settings = {.struct_size = sizeof settings};
    check(texere_settings_default(saved, &settings));
    settings.sides = 12;
    settings.caps = 1;
    struct texere_plan *plan;
    check(texere_plan_new(saved, device, &settings, &plan));
    struct texere_counts counts = {.struct_size = sizeof counts};
    check(texere_plan_counts(plan, &counts));
    printf("%llu rings, %llu triangles\n", (unsigned long long)counts.rings,
           (unsigned long long)counts.triangles);

    texere_plan_free(plan);
    texere_device_free(device);
    texere_yarns_free(saved);
    texere_yarns_free(yarns);
    return 0;
}
