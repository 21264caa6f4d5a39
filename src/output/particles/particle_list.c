#include "output/particles/particle_list.h"

#include "base/memory.h"

#include <string.h>

sb_status sb_particle_list_add(sb_particle_list *list, double time, const char *file, size_t length, sb_error *error)
{
    if (length == 0 || length >= sizeof list->entries->file || memchr(file, '"', length) || memchr(file, '<', length) ||
        memchr(file, '&', length))
        return sb_fail(error, SB_BAD_INPUT, "%.*s: not a valid file name in a list of particle files",
                       length < 300 ? (int)length : 300, file);
    if (sb_grow((void **)&list->entries, &list->capacity, list->count + 1, sizeof *list->entries) != 0)
        return sb_fail_memory(error, "list of particle files");
    sb_particle_entry *entry = &list->entries[list->count++];
    entry->time = time;
    memcpy(entry->file, file, length);
    entry->file[length] = '\0';
    return SB_OK;
}

void sb_particle_list_free(sb_particle_list *list)
{
    sb_free(list->entries);
    *list = (sb_particle_list){0};
}
