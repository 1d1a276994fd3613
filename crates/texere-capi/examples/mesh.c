// From a design to its mesh: mesh DESIGN DEVICE OUTPUT. The mesh goes to arrays, and to the .glb or .ply file OUTPUT.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "texere.h"

// Ends the program if a call failed.
static void check(enum texere_status status) {
    if (status == TEXERE_OK) return;
    struct texere_place place;
    texere_error_place(&place);
    if (place.line) fprintf(stderr, "%s:%llu: ", place.file, (unsigned long long)place.line);
    fprintf(stderr, "%s\n", texere_error_message());
    exit(status);
}

int main(int count, char **arguments) {
    if (count != 4 || texere_abi() != TEXERE_ABI) return 1;
    const char *path = arguments[1], *name = arguments[2], *output = arguments[3];

    struct texere_device *device;
    check(texere_device_open(name, strlen(name), &device));
    struct texere_design *design;
    check(texere_design_read(path, strlen(path), &design));
    struct texere_cloth *cloth;
    check(texere_cloth_rest(design, device, NULL, &cloth));
    struct texere_report report = {.struct_size = sizeof report};
    check(texere_cloth_report(cloth, &report));
    struct texere_yarns *yarns;
    check(texere_cloth_yarns(cloth, &yarns));

    struct texere_plan *plan;
    check(texere_plan_new(yarns, device, NULL, &plan));
    struct texere_counts counts = {.struct_size = sizeof counts};
    check(texere_plan_counts(plan, &counts));
    struct texere_vertex *vertices = malloc(counts.vertices * sizeof *vertices);
    uint32_t *indices = malloc(counts.indices * sizeof *indices);
    if (!vertices || !indices) return 1;
    check(texere_plan_mesh(plan, NULL, vertices, counts.vertices, indices, counts.indices));
    printf("%s: %llu vertices, %llu triangles in %llu draws\n", report.words,
           (unsigned long long)counts.vertices, (unsigned long long)counts.triangles,
           (unsigned long long)counts.draws);
    check(texere_plan_write(plan, NULL, output, strlen(output)));

    free(indices);
    free(vertices);
    texere_plan_free(plan);
    texere_yarns_free(yarns);
    texere_cloth_free(cloth);
    texere_design_free(design);
    texere_device_free(device);
    return 0;
}
