"""Each catalogue translates every text, with the same placeholders, and nothing else."""

import io
import string
import sys
from pathlib import Path
from typing import get_args

import pytest
from babel.messages.pofile import read_po

from nptcs.language import ENGLISH, Language, language, tr, tr_count
from nptcs.language.translate import catalogue_file

sys.path.insert(0, str(Path(__file__).parent))
from messages import as_entry, texts_in_code, texts_in_template, texts_of_package

PROBLEMS = ("{count} problem: {counts}", "{count} problems: {counts}")
OTHERS = [code for code in get_args(Language) if code != ENGLISH]


def entries(code):
    """Return the translations of a catalogue by their English texts."""
    catalogue = read_po(io.BytesIO(catalogue_file(code)), locale=code, abort_invalid=True)
    found = {}
    for message in catalogue:
        if message.id:
            one = isinstance(message.id, str)
            key = (message.id,) if one else tuple(message.id)
            found[key] = (message.string,) if one else tuple(message.string)
    return found


def placeholders(text):
    """Return the names in braces, with how each is formatted."""
    parsed = string.Formatter().parse(text)
    return sorted({(name, form) for _, name, form, _ in parsed if name is not None})


@pytest.mark.parametrize("code", OTHERS)
def test_every_text_has_a_translation(code):
    known = entries(code)
    missing = {texts: where for texts, where in texts_of_package().items() if texts not in known}
    assert not missing, "\n" + "\n".join(as_entry(*item) for item in missing.items())


@pytest.mark.parametrize("code", OTHERS)
def test_no_translation_is_empty_or_waits_for_review(code):
    catalogue = read_po(io.BytesIO(catalogue_file(code)), locale=code, abort_invalid=True)
    assert [message.id for message in catalogue if message.id and message.fuzzy] == []
    assert [key for key, said in entries(code).items() if not all(said)] == []


@pytest.mark.parametrize("code", OTHERS)
def test_translations_have_the_placeholders_of_the_english_text(code):
    for texts, said in entries(code).items():
        wanted = placeholders(texts[-1])
        for translation in said:
            assert placeholders(translation) == wanted, (texts, translation)


def test_texts_are_found_in_code_and_templates():
    code = 'x = tr("a {b}", b=1) + tr_count("one", "many", n) + tr(name) + f(tr(translatable("c")))'
    assert set(texts_in_code(code)) == {("a {b}",), ("one", "many"), ("c",)}
    assert list(texts_in_template("<p>{{ tr('d', e=1) }} {{ tr(f) }}</p>")) == [("d",)]


def test_a_text_is_written_in_the_language_of_the_block():
    assert tr("yes") == "yes"
    with language("zh"):
        assert tr("yes") == "是"
        assert tr_count(*PROBLEMS, 2, counts="a") == "2 个问题：a"
        with language("en"):
            assert tr("yes") == "yes"
    assert tr_count(*PROBLEMS, 1, counts="a") == "1 problem: a"
    assert tr_count(*PROBLEMS, 2, counts="a") == "2 problems: a"


def test_a_text_that_no_catalogue_contains_stays_as_it_is():
    with language("zh"):
        assert tr("Meine {eigene} Studie") == "Meine {eigene} Studie"
        assert tr("") == ""


def test_an_unknown_language_is_refused():
    with pytest.raises(ValueError, match="no language 'xx'"), language("xx"):
        pass
