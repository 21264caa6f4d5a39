#include "base/memory.h"
#include "scene/reader.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool ends_segment(char c)
{
    return c == '\0' || c == '.' || c == '[';
}

/* The item with whose name `rest` begins; the longest such name, because names may contain dots. */
static sb_yaml *item_by_name(const sb_yaml *list, const char *rest, size_t *used)
{
    sb_yaml *found = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const sb_yaml *name = sb_yaml_child(&list->items[i], "name");
        if (!name || name->kind != SB_YAML_SCALAR) continue;
        size_t length = strlen(name->text);
        if (strncmp(rest, name->text, length) != 0 || !ends_segment(rest[length])) continue;
        if (length > 0 && (!found || length > *used)) {
            found = &list->items[i];
            *used = length;
        }
    }
    return found;
}

/* The item by its index, "3" or "[3]". */
static sb_yaml *item_by_index(const sb_yaml *list, const char *rest, size_t *used)
{
    bool bracket = rest[0] == '[';
    const char *digits = rest + bracket;
    if (!isdigit((unsigned char)*digits)) return NULL;
    char *end;
    unsigned long index = strtoul(digits, &end, 10);
    if (bracket && *end++ != ']') return NULL;
    if (!ends_segment(*end) || index >= list->count) return NULL;
    *used = (size_t)(end - rest);
    return &list->items[index];
}

static sb_status step_list(const sb_yaml *list, const char *key, const char *rest, size_t *used, sb_yaml **next,
                           sb_error *error)
{
    *next = item_by_name(list, rest, used);
    if (!*next) *next = item_by_index(list, rest, used);
    if (*next) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "--set: %.200s: no such item in a list of %zu, expected an item's name or its "
                   "index from 0",
                   key, list->count);
}

static sb_status step_map(sb_yaml *map, const char *key, const char *rest, size_t *used, sb_yaml **next,
                          sb_error *error)
{
    size_t length = strcspn(rest, ".[");
    if (length == 0) return sb_fail(error, SB_BAD_INPUT, "--set: %.200s: a part is empty, expected KEY.KEY=VALUE", key);
    *used = length;
    if (sb_yaml_is_null(map)) { /* a block that is missing so far */
        sb_free(map->text);
        map->text = NULL;
        map->kind = SB_YAML_MAP;
    }
    if (map->kind != SB_YAML_MAP)
        return sb_fail(error, SB_BAD_INPUT,
                       "--set: %.200s: the part before %.*s is a single value, expected a block "
                       "or a list",
                       key, (int)length, rest);
    for (size_t i = 0; i < map->count; i++)
        if (strncmp(map->items[i].key, rest, length) == 0 && map->items[i].key[length] == '\0') {
            *next = &map->items[i];
            return SB_OK;
        }
    *next = sb_yaml_append(map, rest, length);
    return *next ? SB_OK : sb_fail_memory(error, "a --set key");
}

/* The node of a key, and the list or block that has it; a key that is missing is added. */
static sb_status find_place(sb_yaml *root, const char *key, sb_yaml **parent, sb_yaml **place, sb_error *error)
{
    sb_yaml *node = root;
    const char *rest = key;
    do {
        size_t used = 0;
        sb_yaml *next = NULL;
        *parent = node;
        sb_status status = node->kind == SB_YAML_LIST ? step_list(node, key, rest, &used, &next, error)
                                                      : step_map(node, key, rest, &used, &next, error);
        if (status != SB_OK) return status;
        node = next;
        rest += used;
        if (*rest == '.' && *++rest == '\0')
            return sb_fail(error, SB_BAD_INPUT, "--set: %.200s: ends in a dot, expected KEY.KEY=VALUE", key);
    } while (*rest);
    *place = node;
    return SB_OK;
}

/* Whether a value is null, and not empty, which is more likely a mistake. */
static bool removes(const sb_yaml *value)
{
    return sb_yaml_is_null(value) && value->text && *value->text;
}

/* A key that find_place has added is an empty scalar of no file. */
static sb_status remove_place(sb_yaml *parent, sb_yaml *place, const char *key, sb_error *error)
{
    if (place->kind == SB_YAML_SCALAR && place->line == 0 && !(place->text && *place->text))
        return sb_fail(error, SB_BAD_INPUT, "--set: %.200s: null removes a key, and the scene has no such key", key);
    sb_yaml_remove(parent, place);
    return SB_OK;
}

sb_status sb_override_apply(sb_yaml *root, const sb_override *override, sb_error *error)
{
    char name[300];
    snprintf(name, sizeof name, "--set: %.200s", override->key);
    sb_yaml value = {0}, *parent = NULL, *place = NULL;
    sb_yaml_source source = {.name = name};
    sb_status status = sb_yaml_parse(source, override->value, strlen(override->value), &value, error);
    if (status != SB_OK) return status;
    status = find_place(root, override->key, &parent, &place, error);
    if (status == SB_OK && removes(&value))
        status = remove_place(parent, place, override->key, error);
    else if (status == SB_OK)
        sb_yaml_replace(place, &value);
    sb_yaml_free(&value);
    return status;
}
