#include "base/file.h"
#include "base/memory.h"
#include "scene/reader.h"

#include <errno.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 4 << 20, ITEMS_MAX = 10000 };

_Static_assert(sizeof(sb_shape) == sizeof(unsigned), "choices are read and written as unsigned");

sb_status sb_reader_fail(sb_reader *reader, const sb_yaml *map, const char *key, const char *format, ...)
{
    char what[600];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    const sb_yaml *child = key ? sb_yaml_child(map, key) : NULL;
    const sb_yaml *node = child ? child : map;
    char place[340] = "--set: ";
    if (node->line > 0) snprintf(place, sizeof place, "%.300s:%d:%d: ", reader->file, node->line, node->column);
    const char *path = reader->path, *dot = key && *path ? "." : "";
    const char *colon = key || *path ? ": " : "";
    return sb_fail(reader->error, SB_BAD_INPUT, "%s%.200s%s%.60s%s%s", place, path, dot, key ? key : "", colon, what);
}

sb_status sb_reader_interval(sb_reader *reader, const sb_yaml *map, const char *key, double interval)
{
    double most = 1e7;
    if (interval <= 0 || reader->scene->duration / interval <= most) return SB_OK;
    return sb_reader_fail(reader, map, key,
                          "%g s fits more than %g times into the duration of %g s, expected a longer interval",
                          interval, most, reader->scene->duration);
}

/* Appends ".name" or "[index]" to the path. Returns the old length, to which the caller cuts it afterwards. */
static size_t path_push(sb_reader *reader, const char *name, size_t index)
{
    size_t length = strlen(reader->path), rest = sizeof reader->path - length;
    if (name)
        snprintf(reader->path + length, rest, "%s%s", length > 0 ? "." : "", name);
    else
        snprintf(reader->path + length, rest, "[%zu]", index);
    return length;
}

static const char *removal_reason(const sb_table *table, const char *name)
{
    for (const sb_removed_key *key = table->removed; key && key->name; key++)
        if (strcmp(key->name, name) == 0) return key->reason;
    return NULL;
}

static sb_status refuse_unknown(sb_reader *reader, const sb_yaml *map, const sb_table *table)
{
    for (size_t i = 0; i < map->count; i++) {
        const sb_yaml *item = &map->items[i];
        if (sb_table_find(table, item->key)) continue;
        sb_yaml place = {.line = item->line > 0 ? item->key_line : 0, .column = item->key_column};
        const char *near = sb_table_nearest(table, item->key), *reason = removal_reason(table, item->key);
        path_push(reader, item->key, 0);
        if (reason) return sb_reader_fail(reader, &place, NULL, "%s", reason);
        if (near) return sb_reader_fail(reader, &place, NULL, "unknown key, did you mean %s?", near);
        char known[400] = "";
        size_t used = 0;
        for (size_t j = 0; j < table->count && used < sizeof known; j++)
            if (table->keys[j].name)
                used +=
                    (size_t)snprintf(known + used, sizeof known - used, "%s%s", j > 0 ? ", " : "", table->keys[j].name);
        return sb_reader_fail(reader, &place, NULL, "unknown key, expected one of %s", known);
    }
    return SB_OK;
}

static sb_status refuse_same_name(sb_reader *reader, const sb_yaml *list, const sb_table *table, const char *items)
{
    if (table->keys[0].type != SB_KEY_NAME) return SB_OK;
    for (size_t i = 0; i < list->count; i++)
        for (size_t j = 0; j < i; j++) {
            const char *name = items + i * table->size + table->keys[0].offset;
            if (strcmp(name, items + j * table->size + table->keys[0].offset) != 0) continue;
            path_push(reader, NULL, i);
            return sb_reader_fail(reader, &list->items[i], table->keys[0].name,
                                  "%s is already the name of item %zu, expected a unique name", name, j);
        }
    return SB_OK;
}

static sb_status make_items(sb_reader *reader, const sb_key *key, size_t count, void *item, char **items)
{
    *items = sb_alloc(count, key->table->size);
    if (!*items) return sb_fail_memory(reader->error, "the scene's lists");
    memcpy((char *)item + key->offset, items, sizeof *items);
    memcpy((char *)item + key->count_offset, &count, sizeof count);
    return SB_OK;
}

/* Reads one item. A plain value is read as a block with the table's first key. */
static sb_status read_item(sb_reader *reader, const sb_yaml *item, const sb_table *table, void *into)
{
    if (!table->plain || item->kind != SB_YAML_SCALAR) return sb_reader_block(reader, item, table, into);
    char name[SB_NAME_MAX];
    sb_yaml only = *item;
    snprintf(name, sizeof name, "%s", table->keys[0].name);
    only.key = name;
    const sb_yaml block = {.kind = SB_YAML_MAP, .line = item->line, .column = item->column, .count = 1, .items = &only};
    return sb_reader_block(reader, &block, table, into);
}

static sb_status read_list(sb_reader *reader, const sb_yaml *list, const sb_key *key, void *item)
{
    if (list->kind != SB_YAML_LIST)
        return sb_reader_fail(reader, list, NULL, "%s, expected a list (items start with \"- \")",
                              list->kind == SB_YAML_MAP ? "is a block of keys"
                              : sb_yaml_is_null(list)   ? "has no value"
                                                        : "is a single value");
    if (list->count > ITEMS_MAX)
        return sb_reader_fail(reader, list, NULL, "has %zu items, expected at most %d", list->count, ITEMS_MAX);
    if (list->count == 0) return SB_OK;
    char *items;
    sb_status status = make_items(reader, key, list->count, item, &items);
    for (size_t i = 0; status == SB_OK && i < list->count; i++) {
        size_t length = path_push(reader, NULL, i);
        status = read_item(reader, &list->items[i], key->table, items + i * key->table->size);
        if (status == SB_OK) reader->path[length] = '\0';
    }
    return status == SB_OK ? refuse_same_name(reader, list, key->table, items) : status;
}

/* Reads the text of a default as if it were written in the scene. */
static sb_status read_default(sb_reader *reader, const sb_key *key, void *field)
{
    const char *text = sb_key_default(key, reader->scene->numerics.preset, reader->scene->dimensions);
    if (!text) return SB_OK;
    sb_yaml node = {0};
    sb_yaml_source source = {.name = key->name};
    sb_status status = sb_yaml_parse(source, text, strlen(text), &node, reader->error);
    if (status != SB_OK) return status;
    status = sb_reader_value(reader, &node, key, field);
    sb_yaml_free(&node);
    return status;
}

static sb_status read_missing(sb_reader *reader, const sb_yaml *map, const sb_key *key, void *field)
{
    bool required = key->flags & SB_KEY_REQUIRED || (key->flags & SB_KEY_REQUIRED_3D && reader->scene->dimensions == 3);
    if (required) {
        char expected[300];
        sb_key_expectation(key, reader->scene->dimensions, expected, sizeof expected);
        return sb_reader_fail(reader, map, NULL, "missing, expected %s", expected);
    }
    if (key->type == SB_KEY_LIST) return SB_OK;
    if (key->type != SB_KEY_BLOCK) return read_default(reader, key, field);
    const sb_yaml empty = {.kind = SB_YAML_MAP, .line = map->line, .column = map->column};
    return sb_reader_block(reader, &empty, key->table, field);
}

static sb_status refuse_row(sb_reader *reader, const sb_yaml *map, const sb_key *key, const char *only)
{
    if (key->name && sb_yaml_child(map, key->name))
        return sb_reader_fail(reader, map, key->name, "does not apply here, expected only for %s", only);
    for (size_t i = 0; !key->name && i < key->table->count; i++) {
        sb_status status = refuse_row(reader, map, &key->table->keys[i], only);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}

static sb_status read_rows(sb_reader *reader, const sb_yaml *map, const sb_table *table, void *item);

static sb_status read_row(sb_reader *reader, const sb_yaml *map, const sb_table *table, const sb_key *key, void *item)
{
    if (!sb_key_applies(key, sb_table_variant(table, item, map))) return refuse_row(reader, map, key, key->only);
    if (!key->name) {
        char *items;
        sb_status status = make_items(reader, key, 1, item, &items);
        return status == SB_OK ? read_rows(reader, map, key->table, items) : status;
    }
    void *field = (char *)item + key->offset;
    const sb_yaml *node = sb_yaml_child(map, key->name);
    size_t length = path_push(reader, key->name, 0);
    sb_status status = !node                       ? read_missing(reader, map, key, field)
                       : key->type == SB_KEY_LIST  ? read_list(reader, node, key, item)
                       : key->type == SB_KEY_BLOCK ? sb_reader_block(reader, node, key->table, field)
                                                   : sb_reader_value(reader, node, key, field);
    if (status == SB_OK) reader->path[length] = '\0';
    return status;
}

static sb_status read_rows(sb_reader *reader, const sb_yaml *map, const sb_table *table, void *item)
{
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < table->count; i++)
        status = read_row(reader, map, table, &table->keys[i], item);
    return status;
}

sb_status sb_reader_block(sb_reader *reader, const sb_yaml *map, const sb_table *table, void *item)
{
    if (map->kind != SB_YAML_MAP)
        return sb_reader_fail(reader, map, NULL, "%s, expected a block of keys",
                              map->kind == SB_YAML_LIST ? "is a list"
                              : sb_yaml_is_null(map)    ? "has no value"
                                                        : "is a single value");
    sb_status status = refuse_unknown(reader, map, table);
    if (status == SB_OK) status = read_rows(reader, map, table, item);
    if (status == SB_OK && table->finish) status = table->finish(reader, map, item);
    return status;
}

static sb_status apply_overrides(sb_yaml *root, const char *preset_name, const sb_override *overrides, size_t count,
                                 sb_error *error)
{
    sb_status status = SB_OK;
    if (preset_name) {
        const sb_key *key = sb_table_find(&sb_numerics_table, "preset");
        size_t at = 0;
        while (key->words[at] && strcmp(key->words[at], preset_name) != 0) at++;
        char expected[100];
        sb_key_range(key, expected, sizeof expected);
        if (!key->words[at])
            return sb_fail(error, SB_BAD_INPUT, "--preset: %.80s is not known, expected %s", preset_name, expected);
        sb_override preset = {.key = "numerics.preset", .value = preset_name};
        status = sb_override_apply(root, &preset, error);
    }
    for (size_t i = 0; status == SB_OK && i < count; i++) status = sb_override_apply(root, &overrides[i], error);
    return status;
}

static sb_status absolute_folder(const char *path, char out[SB_PATH_MAX], sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_path_folder(folder, path);
    _Static_assert(SB_PATH_MAX >= 4096, "realpath needs PATH_MAX bytes");
    if (!realpath(folder, out)) return sb_fail(error, SB_BAD_INPUT, "%.500s: cannot read: %s", path, strerror(errno));
    return SB_OK;
}

static sb_status read_tree(const char *path, const char *preset_name, const sb_override *overrides,
                           size_t override_count, sb_yaml *root, sb_error *error)
{
    char *text;
    size_t length;
    sb_status status = sb_text_read(path, FILE_LIMIT, &text, &length, error);
    if (status != SB_OK) return status;
    sb_yaml_source source = {.name = path, .placed = true};
    status = sb_yaml_parse(source, text, length, root, error);
    sb_free(text);
    if (status == SB_OK && root->kind != SB_YAML_MAP)
        status = sb_fail(error, SB_BAD_INPUT,
                         "%.500s:%d:%d: the scene is not a block of keys, "
                         "expected lines \"key: value\"",
                         path, root->line, root->column);
    if (status == SB_OK) status = apply_overrides(root, preset_name, overrides, override_count, error);
    return status;
}

sb_status sb_scene_read(const char *path, const char *preset_name, const sb_override *overrides, size_t override_count,
                        sb_scene *scene, sb_error *error)
{
    sb_scene built;
    memset(&built, 0, sizeof built); /* including padding: equal scenes have equal bytes */
    built.dimensions = 3;
    sb_yaml root = {0};
    sb_reader reader = {.file = path, .scene = &built, .error = error};
    sb_status status = absolute_folder(path, reader.folder, error);
    if (status == SB_OK) status = read_tree(path, preset_name, overrides, override_count, &root, error);
    if (status == SB_OK) status = sb_reader_block(&reader, &root, &sb_scene_table, &built);
    if (status == SB_OK) {
        built.path = sb_strdup(path);
        if (!built.path) status = sb_fail_memory(error, "the scene's path");
    }
    sb_yaml_free(&root);
    if (status == SB_OK) {
        *scene = built;
        return status;
    }
    sb_scene_free(&built);
    if (error) sb_one_line(error->text); /* the message quotes keys and values, which may contain line breaks */
    return status;
}

void sb_scene_free(sb_scene *scene)
{
    sb_table_free(&sb_scene_table, scene);
    sb_free(scene->path);
    *scene = (sb_scene){0};
}
