"""What an independent validator finds wrong with a PDF."""

import re

import page as validator

# To the validator a carriage return at the end of a stream and the line feed after it are one end
# of a line, so that such a stream seems a byte too short.
LENGTH = "a stream /Length does not match its raw content length"
_STREAM = re.compile(rb"/Length (\d+)[^\r\n]*>>\r?\nstream\r?\n")


def faults(pdf, profile):
    """Return the messages of all rules that the bytes of a PDF break."""
    found = validator.validate_pdf_bytes(pdf, profile=profile)
    assert found.rules.total > 100
    messages = [failure.message for failure in found.failures]
    if LENGTH in messages:
        ends = [stream.end() + int(stream[1]) for stream in _STREAM.finditer(pdf)]
        assert ends
        if all(pdf[end : end + 10] == b"\nendstream" for end in ends):
            messages.remove(LENGTH)
    return messages
