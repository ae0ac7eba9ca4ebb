"""The content security policy of a page that stands alone: no network, no form, no script but its own."""
import base64
import hashlib


def policy(script=""):
    """The policy as an element for the head of a page that has this script."""
    rules = ("default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; "
             "form-action 'none';")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    rules += f" script-src 'sha256-{digest}'" if script else " script-src 'none'"
    return f'<meta http-equiv="Content-Security-Policy" content="{rules}">'
