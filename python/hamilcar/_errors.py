"""What can go wrong, as exceptions: each knows the exit code of the command line and the key that it is about."""


class Error(Exception):
    """Something that hamilcar refuses or cannot do.

    ``exit_code`` is that of the command line for the same mistake, ``key`` the dotted key of a file, or "".
    """

    def __init__(self, message: str, exit_code: int = 6, key: str = ""):
        super().__init__(message)
        self.exit_code = exit_code
        self.key = key


class InputError(Error, ValueError):
    """A file, a key or a value that is not as expected; the message says where, what was found and what is expected."""


class NumericalError(Error, ArithmeticError):
    """A linkage that does not assemble or locks, a car that does not settle, numbers that are no longer finite."""


class AccessError(Error, OSError):
    """A path that cannot be read or written."""

    def __str__(self) -> str:
        return str(self.args[0])


_KINDS = {2: InputError, 3: InputError, 4: NumericalError, 5: AccessError}


def error_of(exit_code: int, message: str, key: str) -> Error:
    return _KINDS.get(exit_code, Error)(message, exit_code, key)
