/* Computes what the slice of a camera shows. */
#include "render/slice/slice.h"

#include "base/memory.h"

sb_status sb_slicer_create(const sb_model *model, sb_slicer *slicer, sb_error *error)
{
    *slicer = (sb_slicer){0};
    return sb_solids_create(model, &slicer->solids, error);
}

void sb_slicer_free(sb_slicer *slicer)
{
    sb_solids_free(&slicer->solids);
    sb_section_free(&slicer->section);
    sb_plane_field_free(&slicer->field);
    sb_streamlines_free(&slicer->streamlines);
    sb_values_free(&slicer->values);
    sb_density_free(&slicer->density);
    sb_free(slicer->terrain);
    sb_free(slicer->bodies);
    *slicer = (sb_slicer){0};
}

void sb_slice_cut(const sb_slice *slice, sb_view *view)
{
    const sb_plane plane = sb_plane_of(slice, view->eye);
    view->cuts = true;
    view->cut_normal = plane.normal;
    /* Faces in the plane count as before it. */
    view->cut_at = sb_dot(plane.normal, plane.point) - 1e-6 * sb_norm(sb_sub(view->eye, plane.point));
}

/* Interpolates the water to the plane; there is none in solid bodies. */
static sb_status fill_field(sb_slicer *s, const sb_slice_job *job, const sb_plane *plane, const sb_plane_area *area,
                            sb_error *error)
{
    sb_plane_field *field = &s->field;
    const sb_density *density = job->density ? job->density : &s->density;
    sb_status status = sb_plane_field_lay(field, area->low, area->high, job->frame->spacing, error);
    /* Cells lie around nodes. */
    const double scale = 1 / field->cell;
    const sb_plane_map to_cells = {
        {{scale, 0, 0.5 - scale * field->low[0]}, {0, scale, 0.5 - scale * field->low[1]}, {0, 0, 1}}};
    if (status == SB_OK)
        status = sb_section_fill(&s->section, &s->solids, plane, area, &to_cells, (int)field->n[0], (int)field->n[1],
                                 field->solid, field->solid, error);
    if (status == SB_OK && !job->density)
        status = sb_density_build(&s->density, job->frame, job->ground, job->threads, error);
    if (status == SB_OK)
        status = sb_values_compute(&s->values, job->frame, job->slice->field, job->range[0], job->range[1], error);
    if (status == SB_OK)
        status = sb_plane_field_fill(field, plane, job->frame, s->values.list, density, job->threads, error);
    return status;
}

static sb_status compute(sb_slicer *s, const sb_slice_job *job, const sb_plane *plane, const sb_plane_area *area,
                         int width, int height, sb_error *error)
{
    const size_t pixels = (size_t)width * (size_t)height;
    const sb_plane_map to_pixels = sb_plane_to_pixels(plane, job->view, width, height);
    if (sb_grow((void **)&s->terrain, &s->cell_capacity[0], pixels, sizeof *s->terrain) != 0 ||
        sb_grow((void **)&s->bodies, &s->cell_capacity[1], pixels, sizeof *s->bodies) != 0)
        return sb_fail_memory(error, "a slice");
    sb_status status = sb_section_cut(&s->section, &s->solids, plane, job->frame, error);
    if (status == SB_OK)
        status = sb_section_fill(&s->section, &s->solids, plane, area, &to_pixels, width, height, s->terrain, s->bodies,
                                 error);
    if (status == SB_OK) status = fill_field(s, job, plane, area, error);
    s->streamlines.line_count = 0;
    if (status == SB_OK && job->slice->streamlines > 0)
        status = sb_streamlines_trace(&s->streamlines, &s->field, job->slice->streamlines, error);
    return status;
}

sb_status sb_slicer_draw(sb_slicer *slicer, const sb_slice_job *job, sb_image *image, sb_error *error)
{
    const sb_plane plane = sb_plane_of(job->slice, job->view->eye);
    const sb_plane_area area = sb_plane_visible(&plane, job->view, job->min, job->max);
    sb_status status = area.count > 0 ? compute(slicer, job, &plane, &area, image->width, image->height, error) : SB_OK;
    if (status == SB_OK) sb_slice_paint(slicer, job, &plane, &area, image);
    return status;
}
