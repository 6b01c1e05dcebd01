"""The form: a page on which a case is described, seen and calculated without a text editor.

`form` says which fields there are, `session` what becomes of what is typed in them, `results` what
is shown beside them; `page` is the widget that joins both to the browser, where
`templates/page/app.mjs` draws them, and `launch` opens it.
"""
