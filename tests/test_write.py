"""Files are written all or none, and replaced only while nobody changed them."""

import itertools
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from killed_writer import NAMES

from pierimpact.checks import InputError
from pierimpact.files import write as write_module
from pierimpact.files.locks import held, is_held, locked
from pierimpact.files.unchanged import (
    RECORD,
    ChangedError,
    put_unchanged,
    refuse_changed,
    remove_unchanged,
)
from pierimpact.files.write import put_in_place, temporary_folder, write_files

ROOT = Path(__file__).parent.parent


def put(folder, contents, **options):
    """Write files as those of a report are."""
    with temporary_folder(folder) as temporary:
        for name, content in contents.items():
            (temporary / name).write_bytes(content)
        return put_unchanged([temporary / name for name in contents], folder, **options)


def contents(folder):
    """Return the bytes of every file in a folder, but for the record of what was written."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.name != RECORD}


def file_names(longest=255):
    """Return names that files may have, with every byte that may be in them."""
    raw = st.binary(min_size=1, max_size=longest).map(
        lambda name: name.replace(b"/", b"x").replace(b"\0", b"x")
    )
    texts = st.text(min_size=1, max_size=40).map(lambda name: name.encode("utf-8", "replace"))
    texts = texts.map(lambda name: name.replace(b"/", b"x").replace(b"\0", b"x")[:longest])
    odd = st.sampled_from([b"-f", b"{A} {0}", b"a\nb", b"%s", b"n" * longest, b" ", b"..."])
    return (raw | texts | odd).filter(lambda name: name not in (b".", b"..")).map(os.fsdecode)


@settings(max_examples=40)
@given(name=file_names(), first=st.binary(), second=st.binary())
def test_names_of_every_kind(tmp_path_factory, name, first, second):
    folder = tmp_path_factory.mktemp("names")
    for content in (first, second):
        write_files({folder / name: content})
        assert contents(folder) == {name: content}
    with pytest.raises(ChangedError):
        put(folder, {name: first})
    for content in (first, second):
        put(folder, {name: content}, force=content == first)
        assert contents(folder) == {name: content}
    remove_unchanged(folder / name)
    assert contents(folder) == {}


@pytest.mark.parametrize("failing", range(3))
@pytest.mark.parametrize("there", [(), NAMES[:1], NAMES], ids=len)
@pytest.mark.parametrize("error", [OSError(5, "the disk is gone"), KeyboardInterrupt()], ids=repr)
def test_moves_that_fail_are_undone(tmp_path, monkeypatch, failing, there, error):
    for name in there:
        (tmp_path / name).write_text(f"old {name}")
    before, replace, count = contents(tmp_path), Path.replace, itertools.count()

    def fails(self, target):
        if next(count) == failing:
            raise error
        return replace(self, target)

    before_written = list(write_module.written)
    with temporary_folder(tmp_path) as temporary:
        files = [temporary / name for name in NAMES]
        for file in files:
            file.write_text("new")
        monkeypatch.setattr(Path, "replace", fails)
        with pytest.raises(type(error)):
            put_in_place(files, tmp_path)
    assert contents(tmp_path) == before
    assert write_module.written == before_written


@pytest.mark.parametrize("place", range(3))
def test_a_folder_in_the_place_of_a_file(tmp_path, place):
    (tmp_path / NAMES[place]).mkdir()
    files = {tmp_path / name: b"new" for name in NAMES}
    with pytest.raises(InputError, match="there is a folder of that name"):
        write_files(files)
    with pytest.raises(ChangedError, match="what is there is no file"):
        put(tmp_path, dict.fromkeys(NAMES, b"new"), force=True)
    assert [path.name for path in tmp_path.iterdir()] == [NAMES[place]]


def test_no_device_is_replaced(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to("pipe")
    for name in ("pipe", "link"):
        with pytest.raises(InputError, match="it is no regular file"):
            write_files({tmp_path / name: b"new"})
    assert (tmp_path / "pipe").is_fifo()


def test_what_a_link_leads_to_is_written(tmp_path):
    (tmp_path / "below").mkdir()
    (tmp_path / "link").symlink_to("below/file")
    write_files({tmp_path / "link": b"new"})
    assert (tmp_path / "link").is_symlink()
    assert contents(tmp_path / "below") == {"file": b"new"}


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match=r"x cannot be written to: No such file or directory$"):
        write_files({tmp_path / "nowhere" / "x": b""})


def test_what_somebody_changed_is_named_and_kept(tmp_path):
    put(tmp_path, {"a.html": b"1", "a.pdf": b"2"})
    put(tmp_path, {"b.html": b"3", "b.pdf": b"4"})
    put(tmp_path, {"a.html": b"5", "a.pdf": b"6"})
    (tmp_path / "a.pdf").write_bytes(b"mine")
    (tmp_path / "b.html").write_bytes(b"mine")
    names = ("a.html", "a.pdf", "b.html", "b.pdf", "c.html")
    with pytest.raises(ChangedError) as caught:
        refuse_changed(tmp_path, names)
    assert str(caught.value) == (
        f"{tmp_path / 'a.pdf'}, {tmp_path / 'b.html'} were not written by pierimpact, or changed "
        "since: move what you want to keep, or give --force to overwrite"
    )
    before = contents(tmp_path)
    for name in "ab":
        with pytest.raises(ChangedError, match="was not written by pierimpact"):
            put(tmp_path, {f"{name}.html": b"7", f"{name}.pdf": b"8"})
        remove_unchanged(tmp_path / f"{name}.{'pdf' if name == 'a' else 'html'}")
    assert contents(tmp_path) == before
    put(tmp_path, {"a.html": b"7", "a.pdf": b"8"}, force=True)
    put(tmp_path, {"a.html": b"9", "a.pdf": b"10"})
    assert contents(tmp_path) == before | {"a.html": b"9", "a.pdf": b"10"}


@pytest.mark.parametrize("record", [b"", b"[]", b"\xff", b'{"a.pdf": 3}', b"[" * 100_000, None])
def test_without_a_record_nothing_is_replaced(tmp_path, record):
    put(tmp_path, {"a.pdf": b"1"})
    (tmp_path / RECORD).unlink()
    if record is not None:
        (tmp_path / RECORD).write_bytes(record)
    with pytest.raises(ChangedError):
        put(tmp_path, {"a.pdf": b"2"})
    assert contents(tmp_path) == {"a.pdf": b"1"}
    put(tmp_path, {"a.pdf": b"2"}, force=True)
    put(tmp_path, {"a.pdf": b"3"})
    assert contents(tmp_path) == {"a.pdf": b"3"}


def test_a_lock_keeps_others_out(tmp_path, monkeypatch):
    monkeypatch.setattr("pierimpact.files.locks._PATIENCE", 0.05)
    with locked(tmp_path), pytest.raises(OSError, match="another run"), locked(tmp_path):
        pass
    with locked(tmp_path):
        pass
    assert not is_held(tmp_path / "file")
    with held(tmp_path / "file"):
        assert is_held(tmp_path / "file")
    assert not is_held(tmp_path / "file")


def test_the_folder_of_a_run_that_lives_is_left_alone(tmp_path):
    with temporary_folder(tmp_path) as first, temporary_folder(tmp_path) as second:
        assert first != second
        (first / "a").write_text("first")
        (second / "b").write_text("second")
        put_in_place([second / "b"], tmp_path)
        put_in_place([first / "a"], tmp_path)
    assert contents(tmp_path) == {"a": b"first", "b": b"second"}


FULL = """
import resource, signal, sys
from pathlib import Path
from pierimpact.checks import InputError
from pierimpact.files.write import write_files
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))
folder = Path(sys.argv[1])
try:
    write_files({folder / "a": b"x" * 40_000, folder / "b": b"x" * 60_000})
except InputError as error:
    print(error)
"""


def test_a_disk_without_room(tmp_path):
    (tmp_path / "a").write_text("old")
    done = subprocess.run(
        [sys.executable, "-c", FULL, tmp_path],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    assert done.stdout == f"{tmp_path / 'b'} cannot be written to: File too large\n"
    assert contents(tmp_path) == {"a": b"old"}


def kill_writers(folder, count, draw):
    """Kill writers of the same files, and check what they leave and what a next run makes of it."""
    number = draw.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
    writers = [
        subprocess.Popen(
            [sys.executable, Path(__file__).with_name("killed_writer.py"), folder, str(who)],
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        for who in range(count)
    ]
    for writer in writers:
        writer.stdout.readline()  # it is at work
    time.sleep(draw.uniform(0.0, 0.05))
    for writer in writers:
        writer.send_signal(number)
    for writer in writers:
        writer.communicate()
    if number != signal.SIGKILL:
        assert list(folder.glob(".pierimpact-*")) == []
    refuse_changed(folder, NAMES)
    assert {path.name for path in folder.iterdir()} == {*NAMES, RECORD}
    (line,) = {line for name in NAMES for line in (folder / name).read_bytes().splitlines()}
    assert all((folder / name).read_bytes() == (line + b"\n") * 20_000 for name in NAMES)


def test_killed_writers_leave_one_set_of_files(tmp_path):
    draw = random.Random(3)
    for _ in range(4):
        kill_writers(tmp_path, 2, draw)


@pytest.mark.attack
def test_two_hundred_times_killed_writers_leave_one_set_of_files(tmp_path):
    draw = random.Random(4)
    for _ in range(200):
        kill_writers(tmp_path, 3, draw)
