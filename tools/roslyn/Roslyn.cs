// The C# compiler as a Mono program: the `csc` of the SDK package needs a .NET runtime with OpenSSL 1.1, but Roslyn itself does not.
// Usage: the arguments of csc.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text;
using Microsoft.CodeAnalysis;
using Microsoft.CodeAnalysis.CSharp;
using Microsoft.CodeAnalysis.Emit;
using Microsoft.CodeAnalysis.Text;

static class Roslyn
{
    static int Main(string[] args)
    {
        var arguments = CSharpCommandLineParser.Default.Parse(args, Directory.GetCurrentDirectory(), null, null);
        if (Report(arguments.Errors)) return 1;
        var trees = new List<SyntaxTree>();
        foreach (var file in arguments.SourceFiles)
        {
            using (var stream = File.OpenRead(file.Path))
            {
                var text = SourceText.From(stream, Encoding.UTF8, SourceHashAlgorithm.Sha256);
                trees.Add(CSharpSyntaxTree.ParseText(text, arguments.ParseOptions, file.Path));
            }
        }
        var references = arguments.MetadataReferences.Select(r => MetadataReference.CreateFromFile(r.Reference, r.Properties));
        var compilation = CSharpCompilation.Create(
            Path.GetFileNameWithoutExtension(arguments.OutputFileName), trees, references, arguments.CompilationOptions);
        var output = Path.Combine(arguments.OutputDirectory, arguments.OutputFileName);
        Directory.CreateDirectory(arguments.OutputDirectory);
        using (var assembly = new MemoryStream())
        using (var symbols = arguments.EmitPdb ? new MemoryStream() : null)
        using (var documentation = arguments.DocumentationPath == null ? null : new MemoryStream())
        {
            var result = compilation.Emit(
                assembly, symbols, documentation,
                options: new EmitOptions(debugInformationFormat: DebugInformationFormat.PortablePdb));
            Report(result.Diagnostics);
            if (!result.Success) return 1;
            File.WriteAllBytes(output, assembly.ToArray());
            var symbolsFile = Path.ChangeExtension(output, ".pdb");
            if (symbols == null) File.Delete(symbolsFile);
            else File.WriteAllBytes(symbolsFile, symbols.ToArray());
            if (documentation != null) File.WriteAllBytes(arguments.DocumentationPath, documentation.ToArray());
        }
        return 0;
    }

    static bool Report(IEnumerable<Diagnostic> diagnostics)
    {
        var failed = false;
        foreach (var diagnostic in diagnostics.Where(d => d.Severity >= DiagnosticSeverity.Warning && !d.IsSuppressed))
        {
            Console.Error.WriteLine(diagnostic);
            failed |= diagnostic.Severity == DiagnosticSeverity.Error;
        }
        return failed;
    }
}
