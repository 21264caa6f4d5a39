#include "output/maps/vti.h"

#include "base/file.h"

#include <inttypes.h>

sb_status sb_vti_write(const char *path, const sb_vti *image, sb_error *error)
{
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    const size_t cells = image->columns * image->rows;
    uint64_t offset = 0;
    fprintf(out.stream,
            SB_VTI_HEAD "<ImageData WholeExtent=\"0 %zu 0 %zu 0 0\" Origin=\"%.17g %.17g 0\" Spacing=\"%.17g %.17g "
                        "%.17g\">\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
                        "format=\"ascii\">%.17g</DataArray>\n</FieldData>\n<Piece Extent=\"0 %zu 0 %zu 0 0\">\n"
                        "<CellData>\n",
            image->columns, image->rows, image->x, image->y, image->cell, image->cell, image->cell, image->time,
            image->columns, image->rows);
    for (size_t k = 0; k < image->array_count; k++) {
        const sb_vti_array *array = &image->arrays[k];
        fprintf(out.stream,
                "<DataArray type=\"Float32\" Name=\"%s\" NumberOfComponents=\"%zu\" format=\"appended\" "
                "offset=\"%" PRIu64 "\"/>\n",
                array->name, array->components, offset);
        offset += sizeof(uint64_t) + cells * array->components * sizeof(float);
    }
    fputs("</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_", out.stream);
    for (size_t k = 0; k < image->array_count; k++) {
        const uint64_t bytes = cells * image->arrays[k].components * sizeof(float);
        fwrite(&bytes, sizeof bytes, 1, out.stream);
        fwrite(image->arrays[k].values, 1, bytes, out.stream);
    }
    fputs("\n</AppendedData>\n</VTKFile>\n", out.stream);
    return sb_atomic_commit(&out, 0, error);
}
