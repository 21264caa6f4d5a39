#include "scene/yaml.h"

#include "base/memory.h"

#include <stdint.h>
#include <string.h>
#include <yaml.h>

enum {
    NODES_MAX = 100000,
    DEPTH_MAX = 32,
    KEYS_MAX = 1000,
    /* libyaml's time is quadratic in these two; no scene comes near them. The outermost bracket may be the document. */
    BRACKETS_MAX = DEPTH_MAX + 1,
    ANCHORS_MAX = 1000
};

typedef struct loader {
    yaml_document_t *document;
    sb_yaml_source source;
    size_t nodes;
    sb_error *error;
} loader;

static sb_status fail_at(sb_yaml_source source, size_t line, size_t column, const char *what, const char *detail,
                         sb_error *error)
{
    if (!source.placed) return sb_fail(error, SB_BAD_INPUT, "%.300s: %.300s%.200s", source.name, what, detail);
    return sb_fail(error, SB_BAD_INPUT, "%.300s:%zu:%zu: %.300s%.200s", source.name, line + 1, column + 1, what,
                   detail);
}

static sb_status fail_mark(const loader *load, yaml_mark_t mark, const char *what, const char *detail)
{
    return fail_at(load->source, mark.line, mark.column, what, detail, load->error);
}

static bool is_tag(const yaml_node_t *node, const char *tag)
{
    return !node->tag || strcmp((const char *)node->tag, tag) == 0;
}

static sb_status load_node(loader *load, int index, int depth, sb_yaml *out);

static sb_status load_scalar(loader *load, const yaml_node_t *node, char **text)
{
    const char *value = (const char *)node->data.scalar.value;
    if (!is_tag(node, YAML_STR_TAG))
        return fail_mark(load, node->start_mark, (const char *)node->tag, ": YAML tags are not used in a scene");
    if (strlen(value) != node->data.scalar.length)
        return fail_mark(load, node->start_mark, "text contains a zero byte", "");
    *text = sb_strdup(value);
    return *text ? SB_OK : sb_fail_memory(load->error, "the scene's YAML tree");
}

static sb_status room(const loader *load, sb_yaml *out, size_t count)
{
    if (count == 0) return SB_OK;
    out->items = sb_alloc(count, sizeof *out->items);
    if (!out->items) return sb_fail_memory(load->error, "the scene's YAML tree");
    out->capacity = count;
    return SB_OK;
}

static sb_status load_list(loader *load, const yaml_node_t *node, int depth, sb_yaml *out)
{
    const yaml_node_item_t *first = node->data.sequence.items.start;
    size_t count = (size_t)(node->data.sequence.items.top - first);
    if (!is_tag(node, YAML_SEQ_TAG))
        return fail_mark(load, node->start_mark, (const char *)node->tag, ": YAML tags are not used in a scene");
    if (count > NODES_MAX) return fail_mark(load, node->start_mark, "list of more than 100000 items", "");
    sb_status status = room(load, out, count);
    for (size_t i = 0; status == SB_OK && i < count; i++)
        status = load_node(load, first[i], depth + 1, &out->items[out->count++]);
    return status;
}

static sb_status load_pair(loader *load, const yaml_node_pair_t *pair, int depth, sb_yaml *map)
{
    const yaml_node_t *key = yaml_document_get_node(load->document, pair->key);
    if (key->type != YAML_SCALAR_NODE)
        return fail_mark(load, key->start_mark, "a key that is a list or a block", ", expected a name");
    sb_yaml *child = &map->items[map->count++];
    child->key_line = (int)key->start_mark.line + 1;
    child->key_column = (int)key->start_mark.column + 1;
    sb_status status = load_scalar(load, key, &child->key);
    if (status != SB_OK) return status;
    for (size_t i = 0; i + 1 < map->count; i++)
        if (strcmp(map->items[i].key, child->key) == 0)
            return fail_mark(load, key->start_mark, child->key, ": given twice, expected each key once");
    return load_node(load, pair->value, depth + 1, child);
}

static sb_status load_map(loader *load, const yaml_node_t *node, int depth, sb_yaml *out)
{
    const yaml_node_pair_t *first = node->data.mapping.pairs.start;
    size_t count = (size_t)(node->data.mapping.pairs.top - first);
    if (!is_tag(node, YAML_MAP_TAG))
        return fail_mark(load, node->start_mark, (const char *)node->tag, ": YAML tags are not used in a scene");
    if (count > KEYS_MAX) return fail_mark(load, node->start_mark, "block of more than 1000 keys", "");
    sb_status status = room(load, out, count);
    for (size_t i = 0; status == SB_OK && i < count; i++) status = load_pair(load, &first[i], depth, out);
    return status;
}

/* An alias has the index of its anchor. Its copy counts against NODES_MAX, and a loop against DEPTH_MAX. */
static sb_status load_node(loader *load, int index, int depth, sb_yaml *out)
{
    const yaml_node_t *node = yaml_document_get_node(load->document, index);
    if (depth > DEPTH_MAX)
        return fail_mark(load, node->start_mark, "nested deeper than 32 levels", ", or an alias that contains itself");
    if (++load->nodes > NODES_MAX)
        return fail_mark(load, node->start_mark, "more than 100000 values", ", with aliases counted at each use");
    if (load->source.placed) {
        out->line = (int)node->start_mark.line + 1;
        out->column = (int)node->start_mark.column + 1;
    }
    if (node->type == YAML_SEQUENCE_NODE) {
        out->kind = SB_YAML_LIST;
        return load_list(load, node, depth, out);
    }
    if (node->type == YAML_MAPPING_NODE) {
        out->kind = SB_YAML_MAP;
        return load_map(load, node, depth, out);
    }
    out->kind = SB_YAML_SCALAR;
    out->quoted = node->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    return load_scalar(load, node, &out->text);
}

/* Line and column (from 0) of a byte, for errors whose place libyaml reports as an offset. */
static yaml_mark_t mark_of(const char *text, size_t length, size_t offset)
{
    yaml_mark_t mark = {0};
    for (size_t i = 0; i < offset && i < length; i++) {
        mark.column++;
        if (text[i] == '\n') {
            mark.line++;
            mark.column = 0;
        }
    }
    return mark;
}

static bool tab_at(const char *text, size_t length, yaml_mark_t mark)
{
    size_t at = 0;
    for (size_t line = 0; at < length && line < mark.line; at++) line += text[at] == '\n';
    return at + mark.column < length && text[at + mark.column] == '\t';
}

static sb_status explain(const yaml_parser_t *parser, sb_yaml_source source, const char *text, size_t length,
                         sb_error *error)
{
    const char *problem = parser->problem ? parser->problem : "cannot be parsed";
    yaml_mark_t mark = parser->problem_mark;
    if (parser->error == YAML_MEMORY_ERROR) return sb_fail_memory(error, "the YAML parser");
    if (parser->error == YAML_READER_ERROR) {
        mark = mark_of(text, length, parser->problem_offset);
        return fail_at(source, mark.line, mark.column, "not UTF-8 text: ", problem, error);
    }
    if (tab_at(text, length, mark))
        return fail_at(source, mark.line, mark.column, "a tab, expected spaces", " for indentation", error);
    return fail_at(source, mark.line, mark.column, "not valid YAML: ", problem, error);
}

/* Counts brackets and anchors with libyaml's scanner, which ignores those in comments and quoted texts. If a text
   cannot be scanned, the parser reports why. The scanner reads ahead by a kilobyte at most. */
static sb_status prescan(sb_yaml_source source, const char *text, size_t length, sb_error *error)
{
    size_t depth = 0, anchors = 0;
    yaml_parser_t parser;
    sb_status status = SB_OK;
    if (!yaml_parser_initialize(&parser)) return sb_fail_memory(error, "the YAML parser");
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    for (bool more = true; more && status == SB_OK;) {
        yaml_token_t token;
        if (!yaml_parser_scan(&parser, &token)) break;
        const yaml_token_type_t type = token.type;
        const yaml_mark_t mark = token.start_mark;
        more = type != YAML_STREAM_END_TOKEN && type != YAML_NO_TOKEN;
        depth += type == YAML_FLOW_SEQUENCE_START_TOKEN || type == YAML_FLOW_MAPPING_START_TOKEN;
        depth -= depth > 0 && (type == YAML_FLOW_SEQUENCE_END_TOKEN || type == YAML_FLOW_MAPPING_END_TOKEN);
        anchors += type == YAML_ANCHOR_TOKEN;
        yaml_token_delete(&token);
        if (depth > BRACKETS_MAX || anchors > ANCHORS_MAX)
            status =
                fail_at(source, mark.line, mark.column,
                        depth > BRACKETS_MAX ? "nested deeper than 32 levels" : "more than 1000 anchors", "", error);
    }
    yaml_parser_delete(&parser);
    return status;
}

static sb_status refuse_second(yaml_parser_t *parser, sb_yaml_source source, const char *text, size_t length,
                               sb_error *error)
{
    yaml_document_t next;
    if (!yaml_parser_load(parser, &next)) return explain(parser, source, text, length, error);
    yaml_mark_t mark = next.start_mark;
    bool more = yaml_document_get_root_node(&next) != NULL;
    yaml_document_delete(&next);
    if (!more) return SB_OK;
    return fail_at(source, mark.line, mark.column, "a second YAML document", ", expected one", error);
}

static sb_status load_document(yaml_parser_t *parser, sb_yaml_source source, const char *text, size_t length,
                               sb_yaml *root, sb_error *error)
{
    yaml_document_t document;
    if (!yaml_parser_load(parser, &document)) return explain(parser, source, text, length, error);
    loader load = {.document = &document, .source = source, .error = error};
    sb_yaml tree = {0};
    sb_status status = SB_OK;
    if (yaml_document_get_root_node(&document)) {
        status = load_node(&load, 1, 0, &tree);
        if (status == SB_OK) status = refuse_second(parser, source, text, length, error);
    } else if (source.placed) {
        status = fail_at(source, 0, 0, "the file is empty", ", expected a scene", error);
    } else {
        tree.text = sb_strdup("");
        if (!tree.text) status = sb_fail_memory(error, "a YAML value");
    }
    yaml_document_delete(&document);
    if (status == SB_OK)
        *root = tree;
    else
        sb_yaml_free(&tree);
    return status;
}

sb_status sb_yaml_parse(sb_yaml_source source, const char *text, size_t length, sb_yaml *root, sb_error *error)
{
    sb_status status = prescan(source, text, length, error);
    if (status != SB_OK) return status;
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser)) return sb_fail_memory(error, "the YAML parser");
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    status = load_document(&parser, source, text, length, root, error);
    yaml_parser_delete(&parser);
    return status;
}

void sb_yaml_free(sb_yaml *node)
{
    for (size_t i = 0; i < node->count; i++) sb_yaml_free(&node->items[i]);
    sb_free(node->items);
    sb_free(node->text);
    sb_free(node->key);
    *node = (sb_yaml){0};
}

sb_yaml *sb_yaml_child(const sb_yaml *map, const char *key)
{
    if (map->kind != SB_YAML_MAP) return NULL;
    for (size_t i = 0; i < map->count; i++)
        if (strcmp(map->items[i].key, key) == 0) return &map->items[i];
    return NULL;
}

bool sb_yaml_is_null(const sb_yaml *node)
{
    static const char *const nulls[] = {"", "~", "null", "Null", "NULL"};
    if (node->kind != SB_YAML_SCALAR || node->quoted) return false;
    for (size_t i = 0; i < sizeof nulls / sizeof *nulls; i++)
        if (strcmp(node->text, nulls[i]) == 0) return true;
    return false;
}

void sb_yaml_replace(sb_yaml *place, sb_yaml *value)
{
    char *key = place->key;
    int line = place->key_line, column = place->key_column;
    place->key = NULL;
    sb_yaml_free(place);
    *place = *value;
    *value = (sb_yaml){0};
    place->key = key;
    place->key_line = line;
    place->key_column = column;
}

void sb_yaml_remove(sb_yaml *parent, sb_yaml *item)
{
    sb_yaml_free(item);
    parent->count--;
    memmove(item, item + 1, (size_t)(parent->items + parent->count - item) * sizeof *item);
    parent->items[parent->count] = (sb_yaml){0};
}

sb_yaml *sb_yaml_append(sb_yaml *map, const char *key, size_t key_length)
{
    char *name = sb_alloc(key_length + 1, 1);
    char *text = sb_strdup("");
    if (!name || !text || sb_grow((void **)&map->items, &map->capacity, map->count + 1, sizeof *map->items) != 0) {
        sb_free(name);
        sb_free(text);
        return NULL;
    }
    memcpy(name, key, key_length);
    sb_yaml *child = &map->items[map->count++];
    *child = (sb_yaml){.key = name, .text = text};
    return child;
}
