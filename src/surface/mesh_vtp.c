/* Meshes as VTK XML PolyData with raw appended data, for ParaView. */
#include "surface/mesh_format.h"

#include <inttypes.h>

static void tag(FILE *stream, const char *type, const char *name, int components, uint64_t bytes, uint64_t *offset)
{
    fprintf(stream,
            "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%" PRIu64
            "\"/>\n",
            type, name, components, *offset);
    *offset += sizeof bytes + bytes;
}

static void data(FILE *stream, const void *values, uint64_t bytes)
{
    fwrite(&bytes, sizeof bytes, 1, stream);
    if (values && bytes) fwrite(values, 1, bytes, stream);
}

static void write_header(FILE *stream, const sb_water_mesh *mesh)
{
    const uint64_t points = mesh->vertices, triangles = mesh->triangles;
    uint64_t offset = 0;
    fprintf(stream,
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
            "<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
            "format=\"appended\" offset=\"%" PRIu64 "\"/>\n</FieldData>\n",
            offset);
    offset += sizeof(uint64_t) + sizeof(double);
    fprintf(stream,
            "<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
            "NumberOfPolys=\"%zu\">\n<PointData Normals=\"normal\">\n",
            mesh->vertices, mesh->triangles);
    tag(stream, "Float32", "normal", 3, 12 * points, &offset);
    tag(stream, "Float32", "velocity", 3, 12 * points, &offset);
    tag(stream, "Float32", "pressure", 1, 4 * points, &offset);
    fputs("</PointData>\n<Points>\n", stream);
    tag(stream, "Float64", "Points", 3, 24 * points, &offset);
    fputs("</Points>\n<Polys>\n", stream);
    tag(stream, "Int32", "connectivity", 1, 12 * triangles, &offset);
    tag(stream, "Int32", "offsets", 1, 4 * triangles, &offset);
    fputs("</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_", stream);
}

static void write_vtp(FILE *stream, const sb_water_mesh *mesh, double time)
{
    const double origin[3] = {mesh->origin.x, mesh->origin.y, mesh->origin.z};
    write_header(stream, mesh);
    data(stream, &time, sizeof time);
    data(stream, mesh->normal, 12 * mesh->vertices);
    data(stream, mesh->velocity, 12 * mesh->vertices);
    data(stream, mesh->pressure, 4 * mesh->vertices);
    data(stream, NULL, 24 * mesh->vertices);
    for (size_t v = 0; v < mesh->vertices; v++) {
        double place[3];
        for (int a = 0; a < 3; a++) place[a] = origin[a] + (double)mesh->position[v][a];
        fwrite(place, sizeof place, 1, stream);
    }
    data(stream, mesh->corner, 12 * mesh->triangles);
    data(stream, NULL, 4 * mesh->triangles);
    for (size_t t = 0; t < mesh->triangles; t++) {
        const int32_t end = (int32_t)(3 * (t + 1));
        fwrite(&end, sizeof end, 1, stream);
    }
    fputs("\n</AppendedData>\n</VTKFile>\n", stream);
}

const sb_mesh_format sb_mesh_vtp = {
    .name = "vtp",
    .summary = "VTK PolyData with binary values, listed in surface.pvd, for ParaView",
    .ending = ".vtp",
    .before = "<?xml version=\"1.0\"?>\n<!-- ",
    .after = " -->\n",
    .write = write_vtp,
};
