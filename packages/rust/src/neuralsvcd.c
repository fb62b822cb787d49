// SPDX-License-Identifier: MIT
// neuralsvcd.c - the library for the crate, and how C lays out its structs: sys.rs compares.
#define NSVCD_NO_STDIO
#define NSVCD_NO_GRADIENT
#define NEURALSVCD_IMPLEMENTATION
#include "neuralsvcd.h"

#define AT(type, field) offsetof(nsvcd_##type, field)
#define END(type) sizeof(nsvcd_##type)

// clang-format off
// The offsets of all fields and the size of each struct, in the order of sys.rs.
extern const size_t nsvcd_rust_layout[];
extern const size_t nsvcd_rust_layout_count;
const size_t nsvcd_rust_layout[] = {
    AT(mesh, positions), AT(mesh, indices), AT(mesh, vertex_count), AT(mesh, triangle_count),
    END(mesh),

    AT(mesh_options, format), AT(mesh_options, origin), AT(mesh_options, scale), END(mesh_options),

    AT(faces, positions), AT(faces, corners), AT(faces, sizes), AT(faces, vertex_count),
    AT(faces, corner_count), AT(faces, face_count), END(faces),

    AT(encode_options, patches), AT(encode_options, patch_radius),
    AT(encode_options, convex_radius), AT(encode_options, open), AT(encode_options, latents),
    AT(encode_options, no_triangles), AT(encode_options, coarse), AT(encode_options, balls),
    AT(encode_options, progress), AT(encode_options, user), END(encode_options),

    AT(body_facts, size), AT(body_facts, patches), AT(body_facts, centre), AT(body_facts, radius),
    AT(body_facts, extent), AT(body_facts, low), AT(body_facts, high),
    AT(body_facts, mean_patch_radius), AT(body_facts, triangles), AT(body_facts, stored_triangles),
    AT(body_facts, quantization_error), AT(body_facts, convex_radius), AT(body_facts, balls),
    AT(body_facts, ball_error), AT(body_facts, latents), AT(body_facts, components),
    AT(body_facts, open_components), AT(body_facts, open_edges), AT(body_facts, open),
    END(body_facts),

    AT(pose, position), AT(pose, rotation), END(pose),

    AT(network_options, pairs), AT(network_options, model), AT(network_options, precision),
    AT(network_options, recall), AT(network_options, inflate), END(network_options),

    AT(mover, body), AT(mover, poses), AT(mover, count), AT(mover, times), AT(mover, scale),
    AT(mover, pivot), END(mover),

    AT(question, a), AT(question, b), AT(question, ask), AT(question, to), AT(question, to_time),
    AT(question, clearance), AT(question, slop), AT(question, tolerance), AT(question, manifold),
    AT(question, method), AT(question, work), AT(question, segments), AT(question, network),
    AT(question, surfaces), AT(question, stop), AT(question, user), END(question),

    AT(range, low), AT(range, high), END(range),

    AT(contact, point), AT(contact, normal), AT(contact, gap), AT(contact, time),
    AT(contact, triangle_a), AT(contact, triangle_b), AT(contact, patch_a), AT(contact, patch_b),
    AT(contact, id), END(contact),

    AT(safe_pose, time), AT(safe_pose, a), AT(safe_pose, b), END(safe_pose),

    AT(opinion, asked), AT(opinion, logit), AT(opinion, distance), AT(opinion, time),
    AT(opinion, patch_a), AT(opinion, patch_b), AT(opinion, candidates), AT(opinion, limited),
    END(opinion),

    AT(answer, verdict), AT(answer, by), AT(answer, why), AT(answer, inside), AT(answer, time),
    AT(answer, distance), AT(answer, safe), AT(answer, depth), AT(answer, push_out),
    AT(answer, contact_count), AT(answer, contacts), AT(answer, nearest), AT(answer, opinion),
    AT(answer, work), END(answer),
};
// clang-format on
const size_t nsvcd_rust_layout_count = sizeof nsvcd_rust_layout / sizeof nsvcd_rust_layout[0];
