// An edit and its undo: edit DESIGN DEVICE MESH. Only the parts of the mesh that an edit changes are made and read
// again. The file MESH gets the mesh as arrays: vertices, then three numbers of vertices for each triangle.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "texere.h"

static void check(enum texere_status status) {
    if (status == TEXERE_OK) return;
    fprintf(stderr, "%s\n", texere_error_message());
    exit(status);
}

// Sets the lift of end 3 at pick 4, brings it to the mesh, and reads the parts that have changed.
static void lift(struct texere_live *live, uint32_t up, struct texere_vertex *vertices, uint32_t *indices) {
    check(texere_live_set_lift(live, 2, 3, up));
    struct texere_update update = {.struct_size = sizeof update};
    check(texere_live_update(live, NULL, &update));
    if (update.anew) exit(1);
    printf("%s: %llu stretches made again\n", up ? "up" : "down", (unsigned long long)update.change_count);
    for (const struct texere_change *c = update.changes; c < update.changes + update.change_count; c++)
        check(texere_live_read(live, c, vertices + c->first_vertex, c->vertex_count, indices + c->first_index,
                               c->index_count));
}

int main(int count, char **arguments) {
    if (count != 4 || texere_abi() != TEXERE_ABI) return 1;
    struct texere_device *device; struct texere_design *design;
    struct texere_cloth *cloth; struct texere_live *live;
    check(texere_device_open(arguments[2], strlen(arguments[2]), &device));
    check(texere_design_read(arguments[1], strlen(arguments[1]), &design));
    check(texere_cloth_placed(design, &cloth));
    check(texere_live_of_cloth(cloth, device, NULL, &live));
    struct texere_update update = {.struct_size = sizeof update};
    check(texere_live_update(live, NULL, &update));
    struct texere_counts counts = {.struct_size = sizeof counts};
    check(texere_live_counts(live, &counts));
    struct texere_vertex *vertices = calloc(counts.vertices, sizeof *vertices);
    uint32_t *indices = calloc(counts.indices, sizeof *indices), up;
    FILE *file = fopen(arguments[3], "wb");
    if (!vertices || !indices || !file) return 1;
    check(texere_live_mesh(live, NULL, vertices, counts.vertices, indices, counts.indices));

    check(texere_live_lift(live, 2, 3, &up));
    lift(live, !up, vertices, indices);
    lift(live, up, vertices, indices);

    fwrite(vertices, sizeof *vertices, counts.vertices, file);
    const struct texere_draw *draw;
    check(texere_live_draws(live, &draw));
    for (uint64_t number = 0; number < counts.draws; number++, draw++)
        for (uint64_t at = draw->first_index; at < draw->first_index + draw->index_count; at++) {
            uint32_t vertex = (uint32_t)(indices[at] + draw->base_vertex);
            fwrite(&vertex, sizeof vertex, 1, file);
        }
    fclose(file), free(indices), free(vertices);
    texere_live_free(live), texere_cloth_free(cloth), texere_design_free(design), texere_device_free(device);
    return 0;
}
