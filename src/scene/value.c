#include "base/input.h"
#include "base/memory.h"
#include "scene/name.h"
#include "scene/reader.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Fails with what is wrong and what the key accepts. */
static sb_status refuse(sb_reader *reader, const sb_yaml *node, const sb_key *key, const char *what)
{
    char expected[300];
    sb_key_expectation(key, reader->scene->dimensions, expected, sizeof expected);
    return sb_reader_fail(reader, node, NULL, "%s, expected %s", what, expected);
}

static sb_status refuse_text(sb_reader *reader, const sb_yaml *node, const sb_key *key, const char *what)
{
    char text[200];
    snprintf(text, sizeof text, "%.80s%s %s", node->text, strlen(node->text) > 80 ? "..." : "", what);
    return refuse(reader, node, key, text);
}

static sb_status require_scalar(sb_reader *reader, const sb_yaml *node, const sb_key *key)
{
    if (node->kind == SB_YAML_LIST) return refuse(reader, node, key, "is a list");
    if (node->kind == SB_YAML_MAP) return refuse(reader, node, key, "is a block of keys");
    return sb_yaml_is_null(node) ? refuse(reader, node, key, "has no value") : SB_OK;
}

static bool in_range(const sb_key *key, double value)
{
    if (key->flags & SB_KEY_ABOVE ? !(value > key->min) : !(value >= key->min)) return false;
    return key->flags & SB_KEY_BELOW ? value < key->max : value <= key->max;
}

static bool is_not_finite(const char *text)
{
    static const char *const names[] = {"nan", ".nan", "inf", ".inf", "infinity"};
    text += *text == '-' || *text == '+';
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcasecmp(text, names[i]) == 0) return true;
    return false;
}

/* strtod alone would accept nan, inf, hexadecimal numbers and leading blanks. */
static sb_status read_number(sb_reader *reader, const sb_yaml *node, const sb_key *key, double *value)
{
    sb_status status = require_scalar(reader, node, key);
    if (status != SB_OK) return status;
    if (node->quoted) return refuse_text(reader, node, key, "is quoted text, not a number");
    if (key->type == SB_KEY_NUMBER && key->words && strcmp(node->text, key->words[0]) == 0) {
        *value = HUGE_VAL;
        return SB_OK;
    }
    if (is_not_finite(node->text)) return refuse_text(reader, node, key, "is not finite");
    char *end;
    double number = strtod(node->text, &end);
    if (node->text[strspn(node->text, "0123456789+-.eE")] != '\0' || *end != '\0')
        return refuse_text(reader, node, key, "is not a number");
    if (!(fabs(number) <= SB_NUMBER_LARGEST))
        return refuse_text(reader, node, key, "is too large: numbers have magnitudes of at most 1e12");
    if (!in_range(key, number)) return refuse_text(reader, node, key, "is out of range");
    *value = number;
    return SB_OK;
}

static sb_status read_integer(sb_reader *reader, const sb_yaml *node, const sb_key *key, int *value)
{
    double number = 0;
    sb_status status = read_number(reader, node, key, &number);
    if (status != SB_OK) return status;
    if (number != floor(number) || fabs(number) > INT_MAX)
        return refuse_text(reader, node, key, "is not a whole number");
    *value = (int)number;
    return SB_OK;
}

static sb_status read_seed(sb_reader *reader, const sb_yaml *node, const sb_key *key, uint64_t *value)
{
    sb_status status = require_scalar(reader, node, key);
    if (status != SB_OK) return status;
    errno = 0;
    if (node->quoted || node->text[strspn(node->text, "0123456789")] != '\0')
        return refuse_text(reader, node, key, "is not a whole number");
    unsigned long long number = strtoull(node->text, NULL, 10);
    if (errno != 0) return refuse_text(reader, node, key, "is out of range");
    *value = number;
    return SB_OK;
}

static sb_status read_switch(sb_reader *reader, const sb_yaml *node, const sb_key *key, bool *value)
{
    sb_status status = require_scalar(reader, node, key);
    if (status != SB_OK) return status;
    bool on = strcmp(node->text, "true") == 0;
    if (node->quoted || (!on && strcmp(node->text, "false") != 0)) return refuse_text(reader, node, key, "is neither");
    *value = on;
    return SB_OK;
}

/* Texts are printed on terminals and must not control them. Control characters of ASCII other than the tab, and those
   from U+0080 to U+009F, are refused. */
static sb_status require_one_line(sb_reader *reader, const sb_yaml *node)
{
    const unsigned char *c = (const unsigned char *)node->text;
    for (; *c; c++) {
        const bool high = c[0] == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0;
        if (high || (*c < ' ' && *c != '\t') || *c == 127)
            return sb_reader_fail(reader, node, NULL, "contains the control character %d, expected text on one line",
                                  high ? c[1] : c[0]);
    }
    return SB_OK;
}

static sb_status copy_text(sb_reader *reader, const char *text, char **value)
{
    *value = sb_strdup(text);
    return *value ? SB_OK : sb_fail_memory(reader->error, "the scene's texts");
}

static sb_status read_name(sb_reader *reader, const sb_yaml *node, const sb_key *key, char *value)
{
    sb_status status = require_scalar(reader, node, key);
    if (status != SB_OK) return status;
    size_t length = strlen(node->text);
    if (length == 0) return refuse(reader, node, key, "is empty");
    if (length >= SB_NAME_MAX) return refuse_text(reader, node, key, "is too long");
    if (strspn(node->text, sb_name_letters) != length)
        return refuse_text(reader, node, key, "has a character that is not allowed in a name");
    if (node->text[0] == '.' || node->text[0] == '-')
        return refuse_text(reader, node, key, "starts with a dot or a dash");
    memcpy(value, node->text, length + 1);
    return SB_OK;
}

static sb_status read_file(sb_reader *reader, const sb_yaml *node, const sb_key *key, char **value)
{
    sb_status status = require_scalar(reader, node, key);
    if (status != SB_OK) return status;
    if (node->text[0] == '\0') return refuse(reader, node, key, "is empty");
    char path[SB_PATH_MAX];
    if (sb_path_join(path, reader->folder, node->text, NULL) != SB_OK)
        return refuse_text(reader, node, key, "is too long");
    struct stat about;
    if (stat(path, &about) != 0 || access(path, R_OK) != 0)
        return sb_reader_fail(reader, node, NULL, "cannot read %.400s: %s, expected a file", path, strerror(errno));
    if (!S_ISREG(about.st_mode))
        return sb_reader_fail(reader, node, NULL, "%.400s is %s, expected a regular file", path,
                              sb_file_kind(about.st_mode));
    return copy_text(reader, path, value);
}

/* Reads the numbers of a list into values..end. In an error the path names the item. */
static sb_status read_numbers(sb_reader *reader, const sb_yaml *node, const sb_key *key, const double *end,
                              double *values)
{
    size_t length = strlen(reader->path);
    sb_key item = *key;
    item.type = SB_KEY_NUMBER;
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && values + i < end; i++) {
        snprintf(reader->path + length, sizeof reader->path - length, "[%zu]", i);
        status = read_number(reader, &node->items[i], &item, &values[i]);
    }
    reader->path[length] = '\0';
    return status;
}

static sb_status make_unit(sb_reader *reader, const sb_yaml *node, const sb_key *key, sb_vec3 *vector)
{
    double length = sb_norm(*vector);
    if (!(length > 0) || !isfinite(length))
        return refuse(reader, node, key, "is not a direction: its length must be a number > 0");
    /* A unit vector keeps its bits, so that a written scene is read back equal. */
    if (fabs(length - 1) > 1e-12) *vector = sb_scale(*vector, 1 / length);
    return SB_OK;
}

static sb_status read_vector(sb_reader *reader, const sb_yaml *node, const sb_key *key, sb_vec3 *value)
{
    bool flat = reader->scene->dimensions == 2 && !(key->flags & SB_KEY_FULL);
    if (node->kind != SB_YAML_LIST) return refuse(reader, node, key, "is not a list of numbers");
    if (node->count != 3 && !(flat && node->count == 2)) {
        char what[64];
        snprintf(what, sizeof what, "has %zu items", node->count);
        return refuse(reader, node, key, what);
    }
    double numbers[3] = {0};
    sb_status status = read_numbers(reader, node, key, numbers + node->count, numbers);
    if (status != SB_OK) return status;
    sb_vec3 vector = node->count == 3 ? sb_vec(numbers[0], numbers[1], numbers[2]) : sb_vec(numbers[0], 0, numbers[1]);
    if (flat && vector.y != 0 && !(key->flags & SB_KEY_ANY_Y))
        return refuse(reader, node, key, "has y other than 0 in a scene of 2 dimensions");
    if (key->flags & SB_KEY_UNIT) {
        status = make_unit(reader, node, key, &vector);
        if (status != SB_OK) return status;
    }
    *value = vector;
    return SB_OK;
}

static sb_status read_place(sb_reader *reader, const sb_yaml *node, const sb_key *key, double *value)
{
    bool flat = reader->scene->dimensions == 2;
    if (node->kind != SB_YAML_LIST) return refuse(reader, node, key, "is not a list of numbers");
    if (node->count != 2 && !(flat && node->count == 1)) {
        char what[64];
        snprintf(what, sizeof what, "has %zu items", node->count);
        return refuse(reader, node, key, what);
    }
    return read_numbers(reader, node, key, value + node->count, value);
}

static sb_status read_color(sb_reader *reader, const sb_yaml *node, const sb_key *key, float *value)
{
    double numbers[3] = {0};
    if (node->kind != SB_YAML_LIST || node->count != 3)
        return refuse(reader, node, key, "is not a list of three numbers");
    sb_status status = read_numbers(reader, node, key, numbers + 3, numbers);
    for (size_t i = 0; status == SB_OK && i < 3; i++) value[i] = (float)numbers[i];
    return status;
}

static sb_status read_choice(sb_reader *reader, const sb_yaml *node, const sb_key *key, void *field)
{
    sb_status status = require_scalar(reader, node, key);
    if (status != SB_OK) return status;
    if (key->type == SB_KEY_KERNEL) {
        const sb_kernel *kernel = sb_kernel_find(node->text);
        *(const sb_kernel **)field = kernel;
        return kernel ? SB_OK : refuse_text(reader, node, key, "is not known");
    }
    if (key->type == SB_KEY_LAW) {
        const sb_wavemaker *law = sb_wavemaker_find(node->text);
        *(const sb_wavemaker **)field = law;
        return law ? SB_OK : refuse_text(reader, node, key, "is not known");
    }
    unsigned at = 0;
    while (key->words[at] && strcmp(key->words[at], node->text) != 0) at++;
    if (!key->words[at]) return refuse_text(reader, node, key, "is not known");
    if (key->type == SB_KEY_LETTER)
        *(char *)field = key->words[at][0];
    else
        memcpy(field, &at, sizeof at);
    return SB_OK;
}

sb_status sb_reader_value(sb_reader *reader, const sb_yaml *node, const sb_key *key, void *field)
{
    switch (key->type) {
    case SB_KEY_NUMBER:
        return read_number(reader, node, key, field);
    case SB_KEY_INTEGER:
        return read_integer(reader, node, key, field);
    case SB_KEY_SEED:
        return read_seed(reader, node, key, field);
    case SB_KEY_SWITCH:
        return read_switch(reader, node, key, field);
    case SB_KEY_NAME:
        return read_name(reader, node, key, field);
    case SB_KEY_FILE:
        return read_file(reader, node, key, field);
    case SB_KEY_VECTOR:
        return read_vector(reader, node, key, field);
    case SB_KEY_PLACE:
        return read_place(reader, node, key, field);
    case SB_KEY_COLOR:
        return read_color(reader, node, key, field);
    case SB_KEY_CHOICE:
    case SB_KEY_LETTER:
    case SB_KEY_KERNEL:
    case SB_KEY_LAW:
        return read_choice(reader, node, key, field);
    case SB_KEY_TEXT: {
        sb_status status = require_scalar(reader, node, key);
        if (status == SB_OK) status = require_one_line(reader, node);
        return status == SB_OK ? copy_text(reader, node->text, field) : status;
    }
    case SB_KEY_BLOCK:
    case SB_KEY_LIST:
        break;
    }
    return sb_reader_fail(reader, node, NULL, "is not a plain value");
}
