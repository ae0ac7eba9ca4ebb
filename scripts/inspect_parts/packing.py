"""Numbers for the page."""
import array
import base64


def packed(kind, numbers):
    """Numbers as the bytes of a typed array, in base64. Little-endian, as in JavaScript on every machine this
    runs on."""
    return base64.b64encode(array.array(kind, numbers).tobytes()).decode()
